#include "mt/bodies_on_blisk.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcherMt.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolverMt.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>

#include "gallery/bullet_world.h"
#include "models/blisk.h"
#include "shapes/seeded.h"

static int processors = 1;

// Bullet's scheduler makes a thread for each processor. std::thread::hardware_concurrency() asks this
// function of the C library for their number.
int get_nprocs() noexcept { return processors; }

namespace octoblisk::bench {
namespace {

constexpr double kFloor = -30.0, kWall = 242.0;  // mm

}  // namespace

void useThreads(int threads) {
  // One scheduler for each number, and none is ever deleted. To change the number of a scheduler is a race,
  // and leaves threads with numbers for which a dispatcher has no room. To delete one whose threads are awake
  // writes to memory that is not its own (btThreadSupportPosix::waitForResponse).
  static std::map<int, btITaskScheduler*> schedulers;
  btITaskScheduler*& scheduler = schedulers[threads];
  processors = threads;
  if (!scheduler) scheduler = btCreateDefaultTaskScheduler();
  if (!scheduler) throw std::runtime_error("this Bullet was built without BT_THREADSAFE");
  if (scheduler->getNumThreads() != threads) throw std::runtime_error("Bullet's scheduler has other threads");
  btSetTaskScheduler(scheduler);
}

BodiesOnBlisk::BodiesOnBlisk(WorldKind world, ShapeKind shapes, int bodies,
                             std::unique_ptr<btBroadphaseInterface> broadphase)
    : broadphase_(std::move(broadphase)) {
  if (world == WorldKind::parallel) {
    dispatcher_ = std::make_unique<btCollisionDispatcherMt>(&configuration_);
    auto pool = std::make_unique<btConstraintSolverPoolMt>(btGetTaskScheduler()->getNumThreads());
    solver_of_large_islands_ = std::make_unique<btSequentialImpulseConstraintSolverMt>();
    world_ = std::make_unique<btDiscreteDynamicsWorldMt>(dispatcher_.get(), broadphase_.get(), pool.get(),
                                                         solver_of_large_islands_.get(), &configuration_);
    solver_ = std::move(pool);
  } else {
    dispatcher_ = std::make_unique<btCollisionDispatcher>(&configuration_);
    solver_ = std::make_unique<btSequentialImpulseConstraintSolver>();
    world_ = std::make_unique<btDiscreteDynamicsWorld>(dispatcher_.get(), broadphase_.get(), solver_.get(),
                                                       &configuration_);
  }
  registerAlgorithm(dispatcher_.get());
  world_->setGravity(btVector3(0, 0, -9810));

  constexpr int kWalls = 24;
  const btVector3 none(0, 0, 0);
  const Solid blisk(std::make_shared<const TriangleMesh>(demos::makeDefaultBlisk().mesh));
  add(fixed_, {&shapes_.concave(shapes, blisk, false), none}, 0, btTransform::getIdentity());
  add(fixed_, {&shapes_.keep<btBoxShape>(btVector3(300, 300, 15)), none}, 0, gallery::at(0, 0, kFloor - 15));
  auto& wall = shapes_.keep<btBoxShape>(btVector3(5, 36, 150));
  for (int k = 0; k < kWalls; ++k) {
    const Eigen::AngleAxisd turn(2.0 * std::numbers::pi * k / kWalls, Vec3::UnitZ());
    add(fixed_, {&wall, none}, 0, toBullet(Pose{turn.toRotationMatrix(), turn * Vec3(kWall + 5.0, 0, 100)}));
  }

  auto& hull = shapes_.keep<btConvexHullShape>();
  const shapes::SharedMesh stone = shapes::ellipsoid({6, 5, 4}, 6);
  for (const Vec3& vertex : stone->vertices()) hull.addPoint(toBullet(vertex), false);
  hull.recalcLocalAabb();
  const Solid jack(shapes::jack(7, 1.5), piecesOfEight(3, 8, 8));
  const Solid profile(inPrincipalFrame(shapes::uProfile(5, 5, 2, 5)), piecesOfEight(3, 0, 4));
  const Kind a_jack = concave(shapes, jack), a_profile = concave(shapes, profile);
  const Kind kinds[] = {convex(shapes_.keep<btSphereShape>(btScalar(5))),
                        a_jack,
                        convex(shapes_.keep<btBoxShape>(btVector3(5, 4, 3))),
                        a_profile,
                        convex(shapes_.keep<btCapsuleShape>(btScalar(3), btScalar(6))),
                        a_jack,
                        convex(hull),
                        a_profile};
  std::mt19937_64 random(1);
  for (int k = 0; k < bodies; ++k) {
    // Layers over the ring of blades, spread evenly by a sequence of low discrepancy.
    constexpr int kLayer = 250;
    const double radius = std::sqrt(std::lerp(140.0 * 140.0, 225.0 * 225.0, std::fmod(0.569840 * k, 1.0))),
                 angle = 2.0 * std::numbers::pi * 0.754877 * k;
    const Vec3 place(radius * std::cos(angle), radius * std::sin(angle), 108.0 + 15.0 * (k / kLayer));
    btRigidBody& body = add(moving_, kinds[static_cast<std::size_t>(k) % std::size(kinds)], 1,
                            toBullet(Pose{shapes::randomRotation(random), place}));
    body.setActivationState(DISABLE_DEACTIVATION);
  }
}

BodiesOnBlisk::~BodiesOnBlisk() {
  for (const auto* bodies : {&moving_, &fixed_}) {
    for (const auto& body : *bodies) world_->removeRigidBody(body.get());
  }
}

int BodiesOnBlisk::lost() const {
  return static_cast<int>(std::ranges::count_if(moving_, [](const auto& body) {
    const Vec3 place = fromBullet(body->getWorldTransform().getOrigin());
    return !(place.z() > kFloor && place.head<2>().norm() < kWall + 10.0);
  }));
}

BodiesOnBlisk::Kind BodiesOnBlisk::convex(btCollisionShape& shape) const {
  btVector3 inertia;
  shape.calculateLocalInertia(1, inertia);
  return {&shape, inertia};
}

BodiesOnBlisk::Kind BodiesOnBlisk::concave(ShapeKind shapes, const Solid& solid) {
  return {&shapes_.concave(shapes, solid, true), toBullet(solid.moments)};
}

btRigidBody& BodiesOnBlisk::add(std::vector<std::unique_ptr<btRigidBody>>& bodies, const Kind& kind,
                                btScalar mass, const btTransform& pose) {
  bodies.push_back(std::make_unique<btRigidBody>(mass, nullptr, kind.shape, kind.inertia));
  btRigidBody& body = *bodies.back();
  body.setFriction(btScalar(0.5));
  body.setCenterOfMassTransform(pose);
  body.setInterpolationWorldTransform(pose);
  world_->addRigidBody(&body);
  return body;
}

}  // namespace octoblisk::bench
