#include "grinding/grinding_cell.h"

#include <btBulletDynamicsCommon.h>

#include "grinding/obstacles.h"
#include "octoblisk/contacts.h"
#include "octoblisk/distance.h"
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

GrindingCell::GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                           std::vector<double> reaches, const Obstacles& obstacles)
    : GrindingCell(std::move(blisk), std::move(parts), std::move(reaches)) {
  obstacles_ = &obstacles;
}

GrindingCell::~GrindingCell() = default;

const ClusteredOctree& GrindingCell::blisk() const { return world_->blisk(); }

std::vector<PartContact> GrindingCell::contactsAt(const Pose& tool_in_blisk) {
  std::vector<PartContact> found;
  world_->move(tool_in_blisk);
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (!world_->mayBeNear(part)) continue;
    const bool may_touch = obstacles_ && obstacles_->mayTouchAny(part);
    if (may_touch) addTouches(part, tool_in_blisk, found);
    const Obstacle* const obstacle = may_touch ? obstacles_->of(part) : nullptr;
    if (may_touch && !obstacle) continue;
    // A manifold holds a few points of a patch, which may stand for others that are worse: ask for all.
    const ClusteredOctree& forbidden = obstacle ? obstacle->tree() : blisk();
    contacts(forbidden, *parts_[part].tree, tool_in_blisk, reaches_[part], contacts_);
    for (Contact& contact : contacts_) {
      if (obstacle) contact.triangle_a = obstacle->triangleOfBlisk(contact.triangle_a);
      found.push_back({part, contact});
    }
  }
  return found;
}

/// Of what the part may touch: the touches, or else the nearest pair.
void GrindingCell::addTouches(std::size_t part, const Pose& tool_in_blisk, std::vector<PartContact>& found) {
  const ClusteredOctree& tree = *parts_[part].tree;
  const auto mayTouch = [&](std::uint32_t triangle) { return obstacles_->mayTouch(part, triangle); };
  contacts(blisk(), tree, tool_in_blisk, 0.0, contacts_);
  const std::size_t before = found.size();
  for (const Contact& contact : contacts_) {
    if (mayTouch(contact.triangle_a)) found.push_back({part, contact});
  }
  if (found.size() > before) return;
  const Clearance nearest = distance(blisk(), tree, tool_in_blisk, {.upper_bound = reaches_[part]});
  if (!nearest.found() || nearest.distance == 0.0 || !mayTouch(nearest.triangle_a)) return;
  Contact contact{.triangle_a = nearest.triangle_a, .triangle_b = nearest.triangle_b};
  contact.point_on_a = nearest.point_on_a;
  contact.point_on_b = nearest.point_on_b;
  contact.normal = (nearest.point_on_a - nearest.point_on_b).normalized();
  contact.distance = nearest.distance;
  found.push_back({part, contact});
}

}  // namespace octoblisk::demos
