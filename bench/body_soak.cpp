// Drops 500 bodies of all kinds on the blisk again and again, for the given number of seconds of wall-clock
// time. MotionClamping keeps fast bodies out of the blisk.
//
//   body_soak [seconds = 300]
//
// Prints one line. Exits with 1 if a body falls through the floor or enters the blisk, if memory grows, or if
// the time was too short to compare memory.
#include <btBulletDynamicsCommon.h>
#include <malloc.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "models/blisk.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/containment.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/motion_clamping.h"
#include "octoblisk_bullet/register.h"
#include "shared/solids.h"

namespace octoblisk::bench {
namespace {

using testing::uniform;

std::size_t heapBytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// A shape, and points in it that must stay outside the blisk. They avoid any hole, because the hole may
/// straddle a blade.
struct Kind {
  std::unique_ptr<btCollisionShape> shape;
  std::vector<Vec3> inside = {Vec3::Zero()};
};

/// Units: millimetres and seconds. The blisk lies on a plane within a ring of walls.
class Soak {
 public:
  static constexpr int kStepsASecond = 240;  ///< bodies move by up to their own size in a step

  Soak() : blisk_(std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh_))) {
    registerAlgorithm(&dispatcher_);
    world_.addAction(&clamping_);
    world_.getDispatchInfo().m_useContinuous = false;  // Bullet's own clamping
    world_.setGravity(btVector3(0, 0, -9810));
    blisk_.setMargin(kMargin);
    addStatic(&blisk_, btTransform::getIdentity());
    addStatic(&ground_, at({0, 0, kFloor}, 0.0));
    for (int k = 0; k < kWalls; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kWalls;
      addStatic(&wall_, at({267.0 * std::cos(angle), 267.0 * std::sin(angle), 300.0}, angle));
    }
    makeKinds();
    for (std::size_t k = 0; k < kBodies; ++k) {
      btCollisionShape* shape = kinds_[k % kinds_.size()].shape.get();
      btVector3 inertia;
      shape->calculateLocalInertia(1, inertia);
      bodies_.push_back(std::make_unique<btRigidBody>(1, nullptr, shape, inertia));
      bodies_.back()->setFriction(btScalar(0.5));
      bodies_.back()->setCcdMotionThreshold(kHalfThickness);
      bodies_.back()->setDamping(btScalar(0.1), btScalar(0.1));
      bodies_.back()->setSleepingThresholds(20, 1);
    }
  }

  ~Soak() {
    lift();
    world_.removeAction(&clamping_);
    for (const auto& body : statics_) world_.removeRigidBody(body.get());
  }
  Soak(const Soak&) = delete;
  Soak& operator=(const Soak&) = delete;

  /// Removes all bodies and their contacts from the world.
  void lift() {
    for (const auto& body : bodies_) {
      if (body->isInWorld()) world_.removeRigidBody(body.get());
    }
  }

  /// Puts the bodies back above the blades.
  void drop(unsigned seed) {
    std::mt19937_64 random(seed);
    solver_.reset();
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) * 0.618 + uniform(random, 0, 0.1),
                   radius = uniform(random, 135, 225);
      const Vec3 place(radius * std::cos(angle), radius * std::sin(angle),
                       112.0 + 14.0 * static_cast<double>(k / 60));
      btRigidBody& body = *bodies_[k];
      body.setWorldTransform(toBullet(Pose{testing::randomRotation(random), place}));
      body.setInterpolationWorldTransform(body.getWorldTransform());
      body.setLinearVelocity(btVector3(0, 0, 0));
      body.setAngularVelocity(btVector3(0, 0, 0));
      body.clearForces();
      body.forceActivationState(ACTIVE_TAG);
      body.setDeactivationTime(0);
      world_.addRigidBody(&body);
    }
  }

  void step() { world_.stepSimulation(kTimeStep, 0); }

  bool allSleep() const {
    return std::ranges::none_of(bodies_, [](const auto& body) { return body->isActive(); });
  }

  /// The number of bodies that are below the floor, beyond the walls, or have a point in the blisk.
  int lost() const {
    int count = 0;
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      const Pose pose = fromBullet(bodies_[k]->getWorldTransform());
      bool is_lost = false;
      for (const Vec3& point : kinds_[k % kinds_.size()].inside) {
        const Vec3 place = pose * point;
        // A body whose position is NaN is lost too.
        is_lost |= !(place.z() > kBelowFloor && place.head<2>().norm() < 275.0) ||
                   locate(surface_, place) == PointLocation::inside;
      }
      count += is_lost;
    }
    return count;
  }

 private:
  static constexpr std::size_t kBodies = 500;
  static constexpr int kWalls = 24;
  static constexpr double kFloor = -30.0;
  /// A body may fall into the plane by as much as it falls in a step. Planes stop no motion.
  static constexpr double kBelowFloor = kFloor - 12.0;
  static constexpr btScalar kMargin = btScalar(0.1);
  static constexpr btScalar kHalfThickness = 1;  ///< of the thinnest body
  static constexpr btScalar kTimeStep = btScalar(1.0 / kStepsASecond);

  static btTransform at(const Vec3& place, double turn) {
    return btTransform(btQuaternion(btVector3(0, 0, 1), btScalar(turn)), toBullet(place));
  }

  void addStatic(btCollisionShape* shape, const btTransform& where) {
    statics_.push_back(std::make_unique<btRigidBody>(0, nullptr, shape));
    statics_.back()->setWorldTransform(where);
    statics_.back()->setFriction(btScalar(0.5));
    world_.addRigidBody(statics_.back().get());
  }

  void makeKinds() {
    std::mt19937_64 random(5);
    kinds_.push_back({std::make_unique<btSphereShape>(btScalar(5))});
    kinds_.push_back({std::make_unique<btBoxShape>(btVector3(5, 4, 3))});
    kinds_.push_back({std::make_unique<btCapsuleShape>(btScalar(3), btScalar(6))});
    auto hull = std::make_unique<btConvexHullShape>();
    for (int corner = 0; corner < 20; ++corner)
      hull->addPoint(toBullet(6.0 * (testing::randomRotation(random) * Vec3::UnitX())), false);
    hull->recalcLocalAabb();
    kinds_.push_back({std::move(hull)});
    auto cross = std::make_unique<btCompoundShape>();
    cross->addChildShape(btTransform::getIdentity(), &bar_);
    cross->addChildShape(at(Vec3::Zero(), std::numbers::pi / 2.0), &bar_);
    kinds_.push_back({std::move(cross)});
    addConcave(testing::torus(5, 2, 16, 8), {{5, 0, 0}, {-5, 0, 0}, {0, 5, 0}, {0, -5, 0}});
    addConcave(testing::uProfile(6, 5, 2.5, 4), {{0, -3.75, 0}});
    addConcave(testing::gear(8, 5, 6.5, 2, 3), {{3.5, 0, 0}, {-3.5, 0, 0}});
    addConcave(testing::bumpySphere(random, 5.0, 1.5, 14), {Vec3::Zero()});
  }

  void addConcave(const testing::SharedMesh& mesh, std::vector<Vec3> inside) {
    auto shape = std::make_unique<ClusteredOctreeShape>(
        std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh)));
    shape->setMargin(kMargin);
    kinds_.push_back({std::move(shape), std::move(inside)});
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::shared_ptr<const TriangleMesh> mesh_ =
      std::make_shared<const TriangleMesh>(demos::makeDefaultBlisk().mesh);
  ClusteredOctreeShape blisk_;
  Surface surface_{blisk_.tree()};
  MotionClamping clamping_;
  btStaticPlaneShape ground_{btVector3(0, 0, 1), 0};
  btBoxShape wall_{btVector3(25, 60, 400)}, bar_{btVector3(6, 2, 2)};
  std::vector<Kind> kinds_;
  std::vector<std::unique_ptr<btRigidBody>> statics_, bodies_;
};

int run(double seconds) {
  constexpr int kMaxSteps = 5 * Soak::kStepsASecond / 4;  // a body that still rolls is removed
  constexpr std::size_t kGrowth = std::size_t{1} << 20;
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  Soak soak;
  unsigned drops = 0;
  long steps = 0;
  int asleep = 0, lost = 0;
  std::size_t warm = 0, heap = 0;
  bool is_compared = false;  // a drop has ended since `warm` was measured
  while (lost == 0 && elapsed() < seconds) {
    soak.drop(++drops);
    for (int step = 1; step <= kMaxSteps && lost == 0 && elapsed() < seconds; ++step, ++steps) {
      soak.step();
      if (step % 12 != 0) continue;
      lost = soak.lost();
      if (!soak.allSleep()) continue;
      ++asleep;
      break;
    }
    soak.lift();
    heap = heapBytes();
    is_compared = warm > 0 && elapsed() >= 0.5 * seconds;
    if (!is_compared) warm = heap;
  }
  const bool is_ok = lost == 0 && is_compared && heap <= warm + kGrowth;
  char was_warm[48] = "not compared";
  if (is_compared)
    std::snprintf(was_warm, sizeof was_warm, "%.2f MB when warm", static_cast<double>(warm) / 1e6);
  std::printf("body_soak: %s, %u drops (%d to sleep), %ld steps in %.0f s, %d lost, heap %.2f MB, %s\n",
              is_ok ? "ok" : "FAILED", drops, asleep, steps, elapsed(), lost, static_cast<double>(heap) / 1e6,
              was_warm);
  return is_ok ? 0 : 1;
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 300.0;
  if (!(seconds > 0.0)) {
    std::fprintf(stderr, "usage: body_soak [seconds]\n");
    return 2;
  }
  return octoblisk::bench::run(seconds);
}
