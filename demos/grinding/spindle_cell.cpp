#include "grinding/spindle_cell.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "models/blisk_axis.h"
#include "models/orientation.h"
#include "models/shared_tree.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/kinematic_body.h"
#include "octoblisk_bullet/register.h"

namespace octoblisk::demos {
namespace {

// Bullet's units here are mm, kg and s: its force is 1 mN, its torque 1 mN·mm.
constexpr double kForcesANewton = 1e3;
constexpr double kTorquesANewtonMetre = 1e6;
constexpr double kSpeedsAMetreASecond = 1e3;
constexpr double kStepSeconds = 1e-4;
constexpr int kSpindleIterations = 200;

double massOfSolid(const TriangleMesh& blisk, double density) {
  const double volume = std::abs(enclosedVolume(blisk));
  if (!(volume > 0.0))
    throw std::invalid_argument(
        "the blisk encloses no volume, so it has no mass: --spindle needs a closed mesh");
  return density * volume;
}

}  // namespace

/// A world that allows contacts to be changed before they are solved.
class WatchedWorld final : public btDiscreteDynamicsWorld {
 public:
  using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;
  std::function<void()> prepare_contacts;

  void performDiscreteCollisionDetection() override {
    btDiscreteDynamicsWorld::performDiscreteCollisionDetection();
    if (prepare_contacts) prepare_contacts();
  }
};

class SpindleCell::World {
 public:
  World(std::shared_ptr<const ClusteredOctree> blisk, const Pose& mesh_in_blisk, const ToolPart& belt,
        double belt_speed, const SpindleOptions& options)
      : options_(options),
        belt_speed_(belt_speed),
        mesh_in_blisk_(mesh_in_blisk),
        loop_(belt.tree->mesh()),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
        blisk_shape_(std::move(blisk)),
        belt_shape_(belt.tree),
        blisk_(infoOf(massOfSolid(blisk_shape_.tree().mesh(), options.density), blisk_shape_)),
        belt_(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &belt_shape_)),
        spindle_(blisk_, btVector3(0, 0, 0), btVector3(0, 0, 1)) {
    for (ClusteredOctreeShape* shape : {&blisk_shape_, &belt_shape_}) shape->setMargin(0);
    registerAlgorithm(&dispatcher_);
    world_.setGravity(btVector3(0, 0, 0));
    btContactSolverInfo& info = world_.getSolverInfo();
    info.m_numIterations = kSpindleIterations;
    info.m_splitImpulse = false;
    info.m_solverMode |= SOLVER_ENABLE_FRICTION_DIRECTION_CACHING;
    blisk_.setActivationState(DISABLE_DEACTIVATION);
    blisk_.setDamping(0, 0);
    world_.addRigidBody(&blisk_);
    addKinematicBody(world_, belt_);
    world_.addConstraint(&spindle_, true);
    spindle_.enableAngularMotor(options.hold > 0.0, 0,
                                btScalar(options.hold * kTorquesANewtonMetre * kStepSeconds));
    world_.prepare_contacts = [this] { prepareContacts(); };
  }
  ~World() {
    world_.removeConstraint(&spindle_);
    world_.removeRigidBody(&belt_);
    world_.removeRigidBody(&blisk_);
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  std::optional<SpindleLoad> loadAt(const Pose& tool_in_mesh, double depth) {
    depth_ = depth;
    tool_in_blisk_ = mesh_in_blisk_ * tool_in_mesh;
    place(blisk_, Pose());
    place(belt_, tool_in_blisk_);
    world_.stepSimulation(btScalar(kStepSeconds), 0);
    return loadOfContacts();
  }

 private:
  static btRigidBody::btRigidBodyConstructionInfo infoOf(double mass, ClusteredOctreeShape& shape) {
    btVector3 inertia(0, 0, 0);
    shape.calculateLocalInertia(btScalar(mass), inertia);
    return {btScalar(mass), nullptr, &shape, inertia};
  }

  /// At rest, without cached contacts.
  void place(btRigidBody& body, const Pose& pose) {
    body.setWorldTransform(toBullet(pose));
    body.setInterpolationWorldTransform(toBullet(pose));
    const btVector3 none(0, 0, 0);
    body.setLinearVelocity(none);
    body.setAngularVelocity(none);
    body.setInterpolationLinearVelocity(none);
    body.setInterpolationAngularVelocity(none);
    body.clearForces();
    broadphase_.getOverlappingPairCache()->cleanProxyFromPairs(body.getBroadphaseHandle(), &dispatcher_);
  }

  /// Calls back with each contact point, and whether the blisk is its first body.
  template <typename Function>
  void forEachTouch(const Function& function) {
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
      btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(m);
      for (int p = 0; p < manifold.getNumContacts(); ++p) {
        btManifoldPoint& point = manifold.getContactPoint(p);
        if (point.getDistance() <= 0) function(point, manifold.getBody0() == &blisk_);
      }
    }
  }

  /// Sets the contacts up as springs with the given total stiffness, as deep as the belt, with friction along
  /// the belt.
  void prepareContacts() {
    int count = 0;
    forEachTouch([&](btManifoldPoint&, bool) { ++count; });
    const double stiffness = options_.stiffness * kForcesANewton / std::max(1, count);
    forEachTouch([&](btManifoldPoint& point, bool blisk_is_first) {
      point.setDistance(btScalar(-depth_));
      point.m_combinedContactStiffness1 = btScalar(stiffness);
      point.m_combinedContactDamping1 = 0;
      point.m_combinedRestitution = 0;
      point.m_contactPointFlags |=
          BT_CONTACT_FLAG_CONTACT_STIFFNESS_DAMPING | BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED;
      const Vec3 on_belt =
          fromBullet(blisk_is_first ? point.getPositionWorldOnB() : point.getPositionWorldOnA());
      const Vec3 normal = fromBullet(point.m_normalWorldOnB);
      Vec3 velocity = belt_speed_ * kSpeedsAMetreASecond *
                      (tool_in_blisk_.rotation * loop_.directionAt(tool_in_blisk_.inverse() * on_belt));
      velocity -= velocity.dot(normal) * normal;
      const double speed = velocity.norm();
      point.m_combinedFriction = btScalar(speed > 0.0 ? options_.friction : 0.0);
      point.m_lateralFrictionDir1 =
          toBullet(speed > 0.0 ? Vec3(velocity / speed) : Vec3(normal.unitOrthogonal()));
      point.m_contactMotion1 = btScalar(blisk_is_first ? speed : -speed);
    });
  }

  std::optional<SpindleLoad> loadOfContacts() {
    const Mat3 mesh_axes = mesh_in_blisk_.rotation.transpose();
    SpindleLoad load;
    int count = 0;
    forEachTouch([&](const btManifoldPoint& point, bool blisk_is_first) {
      ++count;
      const double sign = (blisk_is_first ? 1.0 : -1.0) / (kStepSeconds * kForcesANewton);
      const Vec3 normal = sign * double(point.m_appliedImpulse) * fromBullet(point.m_normalWorldOnB);
      const Vec3 friction =
          sign * double(point.m_appliedImpulseLateral1) * fromBullet(point.m_lateralFrictionDir1);
      const Vec3 arm = 0.5 * fromBullet(point.getPositionWorldOnA() + point.getPositionWorldOnB());
      load.normal_force += normal.norm();
      load.friction_force += friction.norm();
      load.force += mesh_axes * (normal + friction);
      load.torque += arm.cross(normal + friction).z() * kForcesANewton / kTorquesANewtonMetre;
    });
    if (count == 0) return std::nullopt;
    constexpr double kRest = 1e-9;  // rad/s², the residual of the solver
    const double acceleration = double(blisk_.getAngularVelocity().z()) / kStepSeconds;
    load.acceleration = std::abs(acceleration) > kRest ? acceleration : 0.0;
    return load;
  }

  SpindleOptions options_;
  double belt_speed_;
  Pose mesh_in_blisk_, tool_in_blisk_;
  double depth_ = 0.0;
  BeltLoop loop_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  ClusteredOctreeBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  WatchedWorld world_;
  ClusteredOctreeShape blisk_shape_, belt_shape_;
  btRigidBody blisk_, belt_;
  btHingeConstraint spindle_;
};

std::shared_ptr<const ClusteredOctree> onSpindle(std::shared_ptr<const ClusteredOctree> blisk,
                                                 const Pose& mesh_in_blisk) {
  const bool is_there = mesh_in_blisk.rotation.isIdentity(0.0) && mesh_in_blisk.translation.isZero(0.0);
  return is_there ? blisk : treeOf(moved(blisk->mesh(), mesh_in_blisk));
}

SpindleCell::SpindleCell(std::shared_ptr<const ClusteredOctree> blisk, const Pose& mesh_in_blisk,
                         const ToolPart& belt, double belt_speed, const SpindleOptions& options)
    : world_(std::make_unique<World>(std::move(blisk), mesh_in_blisk, belt, belt_speed, options)) {}

SpindleCell::~SpindleCell() = default;

std::optional<SpindleLoad> SpindleCell::loadAt(const Pose& tool_in_mesh, double depth) {
  return world_->loadAt(tool_in_mesh, depth);
}

}  // namespace octoblisk::demos
