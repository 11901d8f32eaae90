#include "paper/robot/arm_multibody.h"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "octoblisk/mass_properties.h"
#include "octoblisk_bullet/convert.h"
#include "paper/robot/arm_bodies.h"

namespace octoblisk::demos {
namespace {

constexpr double kTorqueUnit = 1e6;  // kg mm²/s² per newton metre
constexpr int kFlange = static_cast<int>(RobotCell::kLinks) - 1;

btQuaternion rotationOf(const Mat3& matrix) {
  const Eigen::Quaterniond q(matrix);
  return {btScalar(q.x()), btScalar(q.y()), btScalar(q.z()), btScalar(q.w())};
}

/// Of the flange together with the tool.
MassOfBody withTool(const MassOfBody& flange, const RobotCellSetup& setup) {
  double volume = 0.0;
  for (const ToolPart& part : setup.tool) volume += massProperties(part.tree->mesh()).volume;
  std::vector<MassOfBody> bodies{flange};
  for (const ToolPart& part : setup.tool) {
    const TriangleMesh& mesh = part.tree->mesh();
    const double mass = setup.tool_mass * massProperties(mesh).volume / volume;
    bodies.push_back(setup.tool_in_flange * massOf(mesh, mass));
  }
  return joined(bodies);
}

std::unique_ptr<btCollisionShape> hullOf(const TriangleMesh& mesh, const Vec3& origin) {
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& vertex : mesh.vertices()) hull->addPoint(toBullet(vertex - origin), false);
  hull->recalcLocalAabb();
  hull->setMargin(0);
  return hull;
}

}  // namespace

ArmMultiBody::ArmMultiBody(const RobotCellSetup& setup, btMultiBodyDynamicsWorld& world)
    : world_(world),
      servo_(setup.servo),
      body_(kFlange + 1 + static_cast<int>(setup.tool.size()), 0, btVector3(0, 0, 0), true, false) {
  const std::array<DhRow, 6> rows = dhRows(setup.arm);
  const std::array<LinkBody, 6> shapes = linkBodies(setup.arm);
  Vec3 parent_center = Vec3::Zero();
  for (int link = 0; link <= kFlange; ++link) {
    const auto i = static_cast<std::size_t>(link);
    const TriangleMesh mesh = meshOf(shapes[i]);
    MassOfBody mass = massOf(mesh, shapes[i].mass);
    if (link == kFlange) mass = withTool(mass, setup);
    const Pose in_parent = dhStep(rows[i], 0.0);
    const Mat3 from_parent = in_parent.rotation.transpose();
    body_.setupRevolute(link, btScalar(mass.mass), toBullet(Vec3(mass.inertia.diagonal())), link - 1,
                        rotationOf(from_parent), toBullet(Vec3(from_parent.col(2))),
                        toBullet(Vec3(-parent_center)),
                        toBullet(Vec3(from_parent * in_parent.translation + mass.center)), true);
    parent_center = mass.center;
    centers_.push_back(mass.center);
    link_shapes_.push_back(hullOf(mesh, mass.center));
  }
  for (std::size_t part = 0; part < setup.tool.size(); ++part) {
    body_.setupFixed(kFlange + 1 + static_cast<int>(part), 0, btVector3(0, 0, 0), kFlange,
                     rotationOf(setup.tool_in_flange.rotation.transpose()),
                     toBullet(Vec3(setup.tool_in_flange.translation - parent_center)), btVector3(0, 0, 0));
    part_shapes_.push_back(std::make_unique<ClusteredOctreeShape>(setup.tool[part].tree));
    part_shapes_.back()->setMargin(0);
    part_shapes_.back()->setSolid(false);
  }
  body_.finalizeMultiDof();
  body_.setBaseWorldTransform(btTransform::getIdentity());
  body_.setHasSelfCollision(false);
  body_.setLinearDamping(0);
  body_.setAngularDamping(0);

  world_.addMultiBody(&body_);
  for (std::size_t i = 0; i < link_shapes_.size(); ++i) addCollider(static_cast<int>(i), *link_shapes_[i]);
  for (std::size_t part = 0; part < part_shapes_.size(); ++part) {
    addCollider(kFlange + 1 + static_cast<int>(part), *part_shapes_[part]);
  }
  for (int link = 0; link <= kFlange; ++link) {
    motors_.push_back(std::make_unique<btMultiBodyJointMotor>(&body_, link, 0, 0));
    limits_.push_back(std::make_unique<btMultiBodyJointLimitConstraint>(
        &body_, link, btScalar(setup.arm.least[link]), btScalar(setup.arm.greatest[link])));
    limits_.back()->setMaxAppliedImpulse(BT_LARGE_FLOAT);  // the default of 100 is too small in these units
    world_.addMultiBodyConstraint(motors_.back().get());
    world_.addMultiBodyConstraint(limits_.back().get());
  }
}

ArmMultiBody::~ArmMultiBody() {
  for (const auto& motor : motors_) world_.removeMultiBodyConstraint(motor.get());
  for (const auto& limit : limits_) world_.removeMultiBodyConstraint(limit.get());
  for (const auto& collider : colliders_) world_.removeCollisionObject(collider.get());
  world_.removeMultiBody(&body_);
}

void ArmMultiBody::addCollider(int link, btCollisionShape& shape) {
  auto collider = std::make_unique<btMultiBodyLinkCollider>(&body_, link);
  collider->setCollisionShape(&shape);
  collider->setCollisionFlags(collider->getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
  collider->setActivationState(DISABLE_DEACTIVATION);
  body_.getLink(link).m_collider = collider.get();
  world_.addCollisionObject(collider.get(), btBroadphaseProxy::DefaultFilter,
                            btBroadphaseProxy::StaticFilter);
  colliders_.push_back(std::move(collider));
}

void ArmMultiBody::place(const Joints& joints) {
  for (int link = 0; link <= kFlange; ++link) {
    body_.setJointPos(link, btScalar(joints[link]));
    body_.setJointVel(link, 0);
  }
  body_.clearForcesAndTorques();
  showBodies();
}

Joints ArmMultiBody::joints() const {
  Joints joints;
  for (int link = 0; link <= kFlange; ++link) joints[link] = double(body_.getJointPos(link));
  return joints;
}

void ArmMultiBody::command(const Joints& position, const Joints& rate, double seconds) {
  for (int link = 0; link <= kFlange; ++link) {
    btMultiBodyJointMotor& motor = *motors_[static_cast<std::size_t>(link)];
    // Bullet expects the fraction of the error to correct within the step.
    motor.setPositionTarget(btScalar(position[link]), btScalar(servo_.position_gain * seconds));
    motor.setVelocityTarget(btScalar(servo_.feedforward * rate[link]));
    motor.setMaxAppliedImpulse(btScalar(servo_.torque[link] * kTorqueUnit * seconds));
  }
}

void ArmMultiBody::showBodies() {
  body_.forwardKinematics(rotations_, origins_);
  body_.updateCollisionObjectWorldTransforms(rotations_, origins_);
}

void ArmMultiBody::showBodies(const SixAxisArm& arm, const Joints& joints, const Pose& tool_in_base) {
  const std::array<Pose, 6> frames = linkFrames(arm, joints);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    colliders_[i]->setWorldTransform(toBullet(frames[i] * Pose{Mat3::Identity(), centers_[i]}));
  }
  for (std::size_t body = frames.size(); body < colliders_.size(); ++body) {
    colliders_[body]->setWorldTransform(toBullet(tool_in_base));
  }
}

Pose ArmMultiBody::linkFrame(std::size_t link) const {
  const Pose in_base = fromBullet(colliders_[link]->getWorldTransform());
  return in_base * Pose{Mat3::Identity(), -centers_[link]};
}

Pose ArmMultiBody::toolInBase() const { return fromBullet(colliders_.back()->getWorldTransform()); }

}  // namespace octoblisk::demos
