#include "cell/grinding_cell.h"

#include <btBulletDynamicsCommon.h>

#include "octoblisk/contacts.h"
#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/kinematic_body.h"
#include "octoblisk_bullet/register.h"

namespace octoblisk::demos {

class GrindingCell::World {
 public:
  World(std::shared_ptr<const ClusteredOctree> blisk, const std::vector<ToolPart>& parts,
        const std::vector<double>& reaches)
      : world_(&dispatcher_, &broadphase_, &solver_, &configuration_), blisk_(std::move(blisk)) {
    registerAlgorithm(&dispatcher_);
    world_.addRigidBody(&blisk_.body);
    for (std::size_t part = 0; part < parts.size(); ++part) {
      parts_.push_back(std::make_unique<Body>(parts[part].tree));
      parts_.back()->shape.setContactBreakingThreshold(btScalar(reaches[part]));
      addKinematicBody(world_, parts_.back()->body);
    }
  }

  ~World() {
    for (const auto& part : parts_) world_.removeRigidBody(&part->body);
    world_.removeRigidBody(&blisk_.body);
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const ClusteredOctree& blisk() const { return blisk_.shape.tree(); }

  void move(const Pose& tool_in_blisk) {
    for (const auto& part : parts_) part->body.setWorldTransform(toBullet(tool_in_blisk));
    world_.updateAabbs();
    world_.computeOverlappingPairs();
  }

  /// Whether the broadphase has a pair of the part with the blisk. Bullet gives up bodies beyond 1 km.
  bool mayBeNear(std::size_t part) {
    if (parts_[part]->body.getActivationState() == DISABLE_SIMULATION) return true;
    btBroadphaseProxy *of_blisk = blisk_.body.getBroadphaseHandle(),
                      *of_part = parts_[part]->body.getBroadphaseHandle();
    return broadphase_.getOverlappingPairCache()->findPair(of_blisk, of_part) != nullptr;
  }

 private:
  /// A body and the shape that it has.
  struct Body {
    explicit Body(std::shared_ptr<const ClusteredOctree> tree)
        : shape(std::move(tree)), body(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &shape)) {}

    ClusteredOctreeShape shape;
    btRigidBody body;
  };

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  ClusteredOctreeBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  Body blisk_;
  std::vector<std::unique_ptr<Body>> parts_;
};

GrindingCell::GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                           double reach)
    : GrindingCell(std::move(blisk), parts, std::vector<double>(parts.size(), reach)) {}

GrindingCell::GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                           std::vector<double> reaches)
    : parts_(std::move(parts)),
      reaches_(std::move(reaches)),
      world_(std::make_unique<World>(std::move(blisk), parts_, reaches_)) {}

GrindingCell::~GrindingCell() = default;

const ClusteredOctree& GrindingCell::blisk() const { return world_->blisk(); }

std::vector<PartContact> GrindingCell::contactsAt(const Pose& tool_in_blisk) {
  std::vector<PartContact> found;
  world_->move(tool_in_blisk);
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (!world_->mayBeNear(part)) continue;
    // A manifold holds a few points of a patch, which may stand for others that are worse: ask for all.
    contacts(blisk(), *parts_[part].tree, tool_in_blisk, reaches_[part], contacts_);
    for (const Contact& contact : contacts_) found.push_back({part, contact});
  }
  return found;
}

}  // namespace octoblisk::demos
