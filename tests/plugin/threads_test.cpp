// Separate worlds on separate threads over one tree give the same answers as a single world.
#include <gtest/gtest.h>

#include <latch>
#include <thread>

#include "octoblisk/clustered_octree.h"
#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletWorld;
using testing::PairReport;

constexpr int kThreads = 6;

using SharedTree = std::shared_ptr<const ClusteredOctree>;

/// All answers of a world's queries as numbers, with a count for each kind of query.
struct Answers {
  std::vector<double> numbers;
  int contacts = 0, rays = 0, sweeps = 0;

  void add(const btVector3& v) {
    numbers.insert(numbers.end(), {double(v.x()), double(v.y()), double(v.z())});
  }
};

void testPairs(BulletWorld& world, btCollisionShape& shape, btCollisionShape& convex, std::mt19937_64& random,
               Answers& answers) {
  btCollisionObject a, b, c;
  a.setCollisionShape(&shape);
  b.setCollisionShape(&shape);
  c.setCollisionShape(&convex);
  for (int i = 0; i < 40; ++i) {
    for (btCollisionObject* object : {&a, &b, &c})
      object->setWorldTransform(toBullet(testing::randomPose(random, 1.5)));
    PairReport with_mesh, with_convex;
    world->contactPairTest(&a, &b, with_mesh);
    world->contactPairTest(&c, &a, with_convex);
    for (const PairReport& report : {with_mesh, with_convex}) {
      answers.contacts += !report.points.empty();
      for (const PairReport::Point& point : report.points) {
        answers.add(toBullet(point.on_a));
        answers.numbers.insert(answers.numbers.end(),
                               {point.distance, double(point.index0), double(point.index1)});
      }
    }
  }
}

void cast(BulletWorld& world, const btConvexShape& convex, std::mt19937_64& random, Answers& answers) {
  for (int i = 0; i < 60; ++i) {
    const btVector3 from = toBullet(testing::randomPoint(random, 5.0)),
                    to = toBullet(testing::randomPoint(random, 5.0));
    btCollisionWorld::ClosestRayResultCallback ray(from, to);
    world->rayTest(from, to, ray);
    btCollisionWorld::ClosestConvexResultCallback swept(from, to);
    world->convexSweepTest(&convex, btTransform(btQuaternion::getIdentity(), from),
                           btTransform(btQuaternion::getIdentity(), to), swept);
    answers.rays += ray.hasHit();
    answers.sweeps += swept.hasHit();
    answers.numbers.insert(answers.numbers.end(),
                           {double(ray.m_closestHitFraction), double(swept.m_closestHitFraction)});
    if (swept.hasHit()) answers.add(swept.m_hitNormalWorld);
  }
}

/// Runs all queries in a world that contains the shape several times, at rest and moving.
Answers answersOf(btCollisionShape& shape, unsigned seed) {
  std::mt19937_64 random(seed);
  Answers answers;
  btSphereShape ball(btScalar(0.4));
  btBoxShape box(btVector3(btScalar(0.5), btScalar(0.3), btScalar(0.4)));
  BulletWorld world;
  world.add(shape, 0, at(0, 0, 0));
  std::vector<btRigidBody*> moving{&world.add(shape, 1, at(1.1, 0.2, 2.0)),
                                   &world.add(box, 1, at(-1.9, 0.1, 1.2)),
                                   &world.add(ball, 1, at(0.2, 2.0, 1.5))};
  testPairs(world, shape, box, random, answers);
  for (int round = 0; round < 20; ++round) {
    world.step(6);
    cast(world, ball, random, answers);
    for (const btRigidBody* body : moving) {
      answers.add(body->getWorldTransform().getOrigin());
      answers.add(body->getAngularVelocity());
    }
  }
  return answers;
}

TEST(Threads, worldsOverOneTreeAnswerAsAlone) {
  const SharedTree tree = treeOver(testing::torus(2, 0.7, 24, 12));
  ClusteredOctreeShape shared_shape(tree);
  std::vector<Answers> alone, together(kThreads);
  for (unsigned i = 0; i < kThreads; ++i) alone.push_back(answersOf(shared_shape, i));
  for (const Answers& answers : alone) {
    EXPECT_GT(answers.contacts, 24);  // of 80
    EXPECT_LT(answers.contacts, 79);
    EXPECT_GT(answers.rays, 1200 / 10);
    EXPECT_GT(answers.sweeps, answers.rays);
    EXPECT_LT(answers.sweeps, 1200 * 7 / 10);
  }
  std::latch start(kThreads);
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      ClusteredOctreeShape own_shape(tree);  // of the shared tree
      start.arrive_and_wait();
      together[i] = answersOf(i % 2 ? own_shape : shared_shape, i);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (unsigned i = 0; i < kThreads; ++i) EXPECT_EQ(together[i].numbers, alone[i].numbers) << "thread " << i;
}

}  // namespace
}  // namespace octoblisk
