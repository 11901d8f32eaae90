#include "cell/grinding_cell.h"

#include <btBulletDynamicsCommon.h>

#include "octoblisk/contacts.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/kinematic_body.h"
#include "octoblisk_bullet/register.h"

namespace octoblisk::demos {
namespace {

/// Whether Bullet reports any point of a pair.
class AnyPoint final : public btCollisionWorld::ContactResultCallback {
 public:
  explicit AnyPoint(double reach) { m_closestDistanceThreshold = btScalar(reach); }

  btScalar addSingleResult(btManifoldPoint&, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    found_ = true;
    return 0;
  }
  bool found() const { return found_; }

 private:
  bool found_ = false;
};

}  // namespace

class GrindingCell::World {
 public:
  World(std::shared_ptr<const ClusteredOctree> blisk, const std::vector<ToolPart>& parts)
      : world_(&dispatcher_, &broadphase_, &solver_, &configuration_), blisk_(std::move(blisk)) {
    registerAlgorithm(&dispatcher_);
    world_.addRigidBody(&blisk_.body);
    for (const ToolPart& part : parts) {
      parts_.push_back(std::make_unique<Body>(part.tree));
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
  }

  /// Whether Bullet finds the part within reach of the blisk.
  bool isNear(std::size_t part, double reach) {
    AnyPoint any(reach);
    world_.contactPairTest(&blisk_.body, &parts_[part]->body, any);
    return any.found();
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
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  Body blisk_;
  std::vector<std::unique_ptr<Body>> parts_;
};

GrindingCell::GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                           double reach)
    : parts_(std::move(parts)), reach_(reach), world_(std::make_unique<World>(std::move(blisk), parts_)) {}

GrindingCell::~GrindingCell() = default;

const ClusteredOctree& GrindingCell::blisk() const { return world_->blisk(); }

std::vector<PartContact> GrindingCell::contactsAt(const Pose& tool_in_blisk) {
  std::vector<PartContact> found;
  world_->move(tool_in_blisk);
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (!world_->isNear(part, reach_)) continue;
    // A manifold holds a few points of a patch, which may stand for others that are worse: ask for all.
    contacts(blisk(), *parts_[part].tree, tool_in_blisk, reach_, contacts_);
    for (const Contact& contact : contacts_) found.push_back({part, contact});
  }
  return found;
}

}  // namespace octoblisk::demos
