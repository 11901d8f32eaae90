#include "cell/grinding_cell.h"

#include <btBulletDynamicsCommon.h>

#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/register.h"

namespace octoblisk::demos {
namespace {

/// Collects what Bullet reports of one part (object 0 is the blisk, object 1 the part).
class Report final : public btCollisionWorld::ContactResultCallback {
 public:
  Report(std::size_t part, double reach, std::vector<PartContact>& found)
      : part_(part), reach_(reach), found_(found) {
    m_closestDistanceThreshold = btScalar(reach);
  }

  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int blisk_triangle,
                           const btCollisionObjectWrapper*, int, int part_triangle) override {
    Contact contact;
    contact.point_on_a = fromBullet(point.getPositionWorldOnA());
    contact.point_on_b = fromBullet(point.getPositionWorldOnB());
    contact.normal = fromBullet(point.m_normalWorldOnB);
    contact.distance = double(point.getDistance());
    contact.triangle_a = static_cast<std::uint32_t>(blisk_triangle);
    contact.triangle_b = static_cast<std::uint32_t>(part_triangle);
    if (contact.distance <= reach_) found_.push_back({part_, contact});
    return 0;
  }

 private:
  const std::size_t part_;
  const double reach_;
  std::vector<PartContact>& found_;
};

/// A body and the shape that it has.
struct Body {
  explicit Body(std::shared_ptr<const ClusteredOctree> tree)
      : shape(std::move(tree)), body(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &shape)) {}

  ClusteredOctreeShape shape;
  btRigidBody body;
};

}  // namespace

class GrindingCell::World {
 public:
  World(std::shared_ptr<const ClusteredOctree> blisk, const std::vector<ToolPart>& parts)
      : world_(&dispatcher_, &broadphase_, &solver_, &configuration_), blisk_(std::move(blisk)) {
    registerAlgorithm(&dispatcher_);
    // Kinematic bodies meet static ones only in a group and mask of the caller's own.
    constexpr int kGroup = 1, kMask = -1;
    world_.addRigidBody(&blisk_.body, kGroup, kMask);
    for (const ToolPart& part : parts) {
      parts_.push_back(std::make_unique<Body>(part.tree));
      btRigidBody& body = parts_.back()->body;
      body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
      body.setActivationState(DISABLE_DEACTIVATION);
      world_.addRigidBody(&body, kGroup, kMask);
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

  void report(std::size_t part, double reach, std::vector<PartContact>& found) {
    Report report(part, reach, found);
    world_.contactPairTest(&blisk_.body, &parts_[part]->body, report);
  }

 private:
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
  for (std::size_t part = 0; part < parts_.size(); ++part) world_->report(part, reach_, found);
  return found;
}

}  // namespace octoblisk::demos
