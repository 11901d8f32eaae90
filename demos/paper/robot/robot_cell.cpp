#include "paper/robot/robot_cell.h"

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>

#include "models/require.h"
#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/register.h"
#include "paper/robot/arm_multibody.h"

namespace octoblisk::demos {
namespace {

constexpr double kGravity = 9810.0;     // mm/s²
constexpr int kSolverIterations = 200;  // enough for six motors on one chain

RobotCellSetup checked(RobotCellSetup setup) {
  require(setup.blisk != nullptr, "a robot cell needs a blisk");
  require(!setup.tool.empty(), "a robot cell needs a tool with at least one part");
  require(setup.tool_mass >= 0.0, "the tool's mass must be at least 0 kg");
  require(setup.servo.position_gain >= 0.0, "the servos' position gain must be at least 0 per second");
  require(setup.servo.feedforward >= 0.0, "the servos' feedforward must be at least 0");
  require((setup.servo.torque.array() >= 0.0).all(), "the motors' torques must be at least 0 N m");
  return setup;
}

/// Collects the contacts of one body with the blisk.
class ContactsOfBody final : public btCollisionWorld::ContactResultCallback {
 public:
  ContactsOfBody(const btCollisionObject& blisk, double reach, std::vector<CellContact>& found)
      : blisk_(blisk), reach_(reach), found_(found) {}

  std::size_t body = 0;

  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* first, int, int index0,
                           const btCollisionObjectWrapper*, int, int index1) override {
    if (double(point.getDistance()) > reach_) return 0;
    const bool blisk_is_first = first->getCollisionObject() == &blisk_;
    found_.push_back(
        {body, static_cast<std::uint32_t>(blisk_is_first ? index0 : index1), double(point.getDistance()),
         fromBullet(blisk_is_first ? point.getPositionWorldOnA() : point.getPositionWorldOnB())});
    return 0;
  }

 private:
  const btCollisionObject& blisk_;
  double reach_;
  std::vector<CellContact>& found_;
};

}  // namespace

class RobotCell::World {
 public:
  explicit World(const RobotCellSetup& setup)
      : world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
        blisk_shape_(setup.blisk),
        blisk_(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &blisk_shape_)),
        arm_(setup, world_) {
    blisk_shape_.setMargin(0);
    blisk_shape_.setSolid(false);  // a tool wholly inside does not touch
    registerAlgorithm(&dispatcher_);
    world_.setGravity(btVector3(0, 0, btScalar(-kGravity)));
    world_.getSolverInfo().m_numIterations = kSolverIterations;
    blisk_.setWorldTransform(toBullet(setup.blisk_in_base));
    blisk_.setCollisionFlags(blisk_.getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
    world_.addRigidBody(&blisk_);
    // Contacts have no effect, so a step does not compute any; detect() computes them when needed.
    dispatcher_.setNearCallback([](btBroadphasePair&, btCollisionDispatcher&, const btDispatcherInfo&) {});
    reach(0.0);
  }
  ~World() { world_.removeRigidBody(&blisk_); }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  ArmMultiBody& arm() { return arm_; }
  const ArmMultiBody& arm() const { return arm_; }

  void step(double seconds) { world_.stepSimulation(btScalar(seconds), 0); }

  /// The contacts of all shown bodies, up to a distance.
  void contacts(double reach_of_contacts, std::vector<CellContact>& found) {
    found.clear();
    reach(reach_of_contacts);
    world_.updateAabbs();
    world_.computeOverlappingPairs();
    near_.clear();
    const btBroadphasePairArray& pairs = broadphase_.getOverlappingPairCache()->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); ++i) {
      for (const btBroadphaseProxy* proxy : {pairs[i].m_pProxy0, pairs[i].m_pProxy1}) {
        auto* object = static_cast<btCollisionObject*>(proxy->m_clientObject);
        if (auto* link = btMultiBodyLinkCollider::upcast(object)) {
          near_.push_back(static_cast<std::size_t>(link->m_link));
        }
      }
    }
    std::ranges::sort(near_);
    ContactsOfBody of_body(blisk_, reach_of_contacts, found);
    for (const std::size_t body : near_) {
      of_body.body = body;
      world_.contactPairTest(&blisk_, &arm_.collider(body), of_body);
    }
  }

 private:
  /// Sets the reach of broadphase and contacts: Bullet's own default, 0.02, depends on the unit of length.
  void reach(double distance) {
    blisk_shape_.setContactBreakingThreshold(btScalar(distance));
    for (std::size_t part = 0; part + kLinks < arm_.bodies(); ++part) {
      arm_.shapeOfPart(part).setContactBreakingThreshold(btScalar(distance));
    }
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  ClusteredOctreeBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_;
  ClusteredOctreeShape blisk_shape_;
  btRigidBody blisk_;
  ArmMultiBody arm_;
  std::vector<std::size_t> near_;  // bodies
};

RobotCell::RobotCell(RobotCellSetup setup)
    : setup_(checked(std::move(setup))), world_(std::make_unique<World>(setup_)) {
  place(Joints::Zero());
}

RobotCell::~RobotCell() = default;

void RobotCell::place(const Joints& joints) { world_->arm().place(joints); }

void RobotCell::drive(const Joints& from, const Joints& to, double seconds, int steps,
                      const Joints& encoder_error) {
  const double step = seconds / steps;
  const Joints rate = (to - from) / seconds;
  for (int i = 0; i < steps; ++i) {
    const Joints position = from + i * step * rate;
    world_->arm().command(position - encoder_error, rate, step);
    world_->step(step);
  }
}

Joints RobotCell::joints() const { return world_->arm().joints(); }
Pose RobotCell::linkFrame(std::size_t link) const { return world_->arm().linkFrame(link); }

Pose RobotCell::toolInBlisk() const { return setup_.blisk_in_base.inverse() * world_->arm().toolInBase(); }

Pose RobotCell::toolInBlisk(const StateEstimate& estimate) const {
  return setup_.blisk_in_base.inverse() * flangeAt(setup_.arm, estimate.joints) * setup_.tool_in_flange *
         estimate.tool_error;
}

std::span<const CellContact> RobotCell::detect(const StateEstimate& estimate, double reach) {
  ArmMultiBody& arm = world_->arm();
  arm.showBodies(setup_.arm, estimate.joints, setup_.blisk_in_base * toolInBlisk(estimate));
  world_->contacts(reach, contacts_);
  arm.showBodies();
  return contacts_;
}

}  // namespace octoblisk::demos
