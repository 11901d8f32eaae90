// Tests the contacts reported for a kinematic tool at a static part, with the part's blades.
#include "octoblisk_bullet/contact_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "octoblisk_bullet/kinematic_body.h"
#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/body_contacts.h"
#include "shared/meshes.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletWorld;

constexpr int kBlades = 5, kSegments = 8;

/// A body of mass 0 that is in a world while it exists.
struct Added {
  Added(BulletWorld& to, btCollisionShape& shape, bool kinematic) : world(to), body(0, nullptr, &shape) {
    if (kinematic) {
      addKinematicBody(*world, body);
    } else {
      world->addRigidBody(&body);
    }
  }
  ~Added() { world->removeRigidBody(&body); }
  Added(const Added&) = delete;
  Added& operator=(const Added&) = delete;

  BulletWorld& world;
  btRigidBody body;
};

std::vector<ReportedContact> report(BulletWorld& world, std::span<const BladeTable> blades = {},
                                    btScalar up_to = btScalar(BT_LARGE_FLOAT)) {
  world->performDiscreteCollisionDetection();
  std::vector<ReportedContact> found(3);  // must be replaced
  reportContacts(world.dispatcher(), found, blades, up_to);
  return found;
}

TEST(KinematicBody, meetsStaticAndDynamicBodiesButNotItsLike) {
  ClusteredOctreeShape torus = shapeOver(testing::torus(2, 0.7, 24, 12));
  BulletWorld world;
  Added fixed(world, torus, false), tool(world, torus, true), other_tool(world, torus, true);
  btRigidBody& falling = world.add(torus, 1, at(0, 0, 1));
  tool.body.setWorldTransform(at(1, 0, 0));
  other_tool.body.setWorldTransform(at(1.2, 0.3, 0));
  std::vector<std::pair<const btCollisionObject*, const btCollisionObject*>> pairs;
  for (const ReportedContact& contact : report(world)) pairs.emplace_back(contact.a.object, contact.b.object);
  const auto met = [&](const btRigidBody& a, const btRigidBody& b) {
    return std::ranges::count(pairs, std::pair<const btCollisionObject*, const btCollisionObject*>(&a, &b)) >
           0;
  };
  EXPECT_TRUE(met(fixed.body, tool.body));
  EXPECT_TRUE(met(fixed.body, other_tool.body));
  EXPECT_TRUE(met(fixed.body, falling));
  EXPECT_TRUE(met(tool.body, falling));
  EXPECT_FALSE(met(tool.body, other_tool.body));
  EXPECT_TRUE(std::ranges::is_sorted(pairs, {}, [](const auto& pair) {
    return std::pair(pair.first->getBroadphaseHandle()->getUid(),
                     pair.second->getBroadphaseHandle()->getUid());
  }));
  world.step(3);
  EXPECT_EQ(tool.body.getWorldTransform().getOrigin().x(), 1);  // no solver moves it
}

TEST(KinematicBody, byTheWorldsOwnWayHasNoContactWithAStaticOne) {
  ClusteredOctreeShape torus = shapeOver(testing::torus(2, 0.7, 24, 12));
  BulletWorld world;
  Added fixed(world, torus, false);
  btRigidBody tool(0, nullptr, &torus);
  tool.setCollisionFlags(tool.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  tool.setActivationState(DISABLE_DEACTIVATION);
  tool.setWorldTransform(at(1, 0, 0));
  world->addRigidBody(&tool);
  EXPECT_TRUE(report(world).empty());
  world->removeRigidBody(&tool);
  addKinematicBody(*world, tool);
  EXPECT_FALSE(report(world).empty());
  world->removeRigidBody(&tool);
  EXPECT_EQ(world.dispatcher().getNumManifolds(), 0);
}

TEST(ContactReport, aToolAtABlisk_vs_bruteforce) {
  // A fan with two blades to a part, and one single blade.
  const auto fan = testing::fan(kBlades, kSegments);
  const auto triangles = static_cast<std::uint32_t>(fan->triangleCount() / kBlades);
  ASSERT_EQ(triangles * kBlades, fan->triangleCount());
  std::vector<int> blade_of_triangle;
  for (std::uint32_t i = 0; i < fan->triangleCount(); ++i)
    blade_of_triangle.push_back(1 + int(i / triangles));
  const std::vector<std::uint32_t> part_begin{0, 2 * triangles, 4 * triangles};
  ClusteredOctreeShape blisk = shapeOver(fan, part_begin), tool = shapeOver(testing::torus(0.6, 0.2, 16, 8));
  btCompoundShape compound;  // Bullet puts a compound first in its manifolds
  compound.addChildShape(btTransform::getIdentity(), &tool);
  std::mt19937_64 random(95);
  int touching = 0, several_blades = 0;
  constexpr int kPoses = 120;
  for (int i = 0; i < kPoses; ++i) {
    BulletWorld world;
    const bool tool_first = i % 2;
    btCollisionShape& tool_shape = i % 3 ? static_cast<btCollisionShape&>(tool) : compound;
    btCollisionShape &first_shape = tool_first ? tool_shape : blisk,
                     &second_shape = tool_first ? blisk : tool_shape;
    Added first(world, first_shape, tool_first), second(world, second_shape, !tool_first);
    btRigidBody &blisk_body = tool_first ? second.body : first.body,
                &tool_body = tool_first ? first.body : second.body;
    tool_body.setWorldTransform(toBullet(testing::randomPose(random, 1.7)));
    const BladeTable tables[] = {{&blisk_body, blade_of_triangle}};
    const std::vector<ReportedContact> found = report(world, tables, 0);
    const Pose tool_in_blisk = fromBullet(tool_body.getWorldTransform());
    std::vector<Contact> contacts;
    for (const ReportedContact& contact : found) {
      ASSERT_EQ(contact.a.object, &first.body);
      ASSERT_EQ(contact.b.object, &second.body);
      const ContactBody &on_blisk = tool_first ? contact.b : contact.a,
                        &on_tool = tool_first ? contact.a : contact.b;
      const std::uint32_t triangle = part_begin[static_cast<std::size_t>(on_blisk.triangle.part)] +
                                     std::uint32_t(on_blisk.triangle.index);
      ASSERT_EQ(on_blisk.blade, int(triangle / triangles) + 1);
      ASSERT_EQ(on_tool.blade, 0);
      contacts.push_back({fromBullet(on_blisk.point), fromBullet(on_tool.point),
                          fromBullet(contact.normal) * (tool_first ? -1.0 : 1.0), double(contact.distance),
                          triangle, std::uint32_t(on_tool.triangle.index)});
      several_blades += on_blisk.blade != (tool_first ? found[0].b : found[0].a).blade;
    }
    ASSERT_EQ(testing::faultOfContacts(*fan, tool.tree().mesh(), tool_in_blisk, 0.0, 0.0, 1e-4, contacts), "")
        << i;
    touching += !found.empty();
  }
  EXPECT_GT(touching, kPoses * 3 / 10);
  EXPECT_LT(touching, kPoses * 7 / 10);
  EXPECT_GT(several_blades, 0);
}

/// The algorithm sets the distance of such a point to 0 for Bullet's solver.
TEST(ContactReport, aBodyThatBouncesKeepsItsDepth) {
  auto floor = shapeOver(testing::waveSheet(10, 0.0, 1));
  btSphereShape ball(btScalar(0.5));
  for (const double restitution : {0.0, 0.5}) {
    constexpr double kDepth = 0.05;
    BulletWorld world;
    world.add(floor, 0, at(0, 0, 0)).setRestitution(1);
    btRigidBody& body = world.add(ball, 1, at(0.1, 0.2, 0.5 - kDepth));
    body.setRestitution(btScalar(restitution));
    body.setLinearVelocity(btVector3(0, 0, -10));
    world.step(1, 1.0 / 60.0);
    std::vector<ReportedContact> found;
    reportContacts(world.dispatcher(), found, {}, btScalar(-0.9 * kDepth));
    ASSERT_EQ(found.size(), 1u) << restitution;
    EXPECT_NEAR(found[0].distance, -kDepth, 1e-5);
  }
}

TEST(ContactReport, doesNotDependOnTheOrderOfManifolds) {
  // Tools reach the part all at once, or one by one in reverse order.
  ClusteredOctreeShape torus = shapeOver(testing::torus(2, 0.7, 24, 12));
  btSphereShape ball(btScalar(0.9));
  const auto numbers = [&](bool one_by_one) {
    BulletWorld world;
    std::vector<std::unique_ptr<Added>> bodies;
    for (int i = 0; i <= 6; ++i) {
      btCollisionShape& shape = i % 2 ? static_cast<btCollisionShape&>(ball) : torus;
      bodies.push_back(std::make_unique<Added>(world, shape, i > 0));
      if (i > 0) bodies.back()->body.setWorldTransform(at(100.0 * i, 0, 0));
    }
    world->performDiscreteCollisionDetection();
    EXPECT_TRUE(report(world).empty());
    for (std::size_t i = bodies.size() - 1; i > 0; --i) {
      bodies[i]->body.setWorldTransform(at(1.0 + 0.2 * double(i), 0, 0));
      if (one_by_one) world->performDiscreteCollisionDetection();
    }
    std::vector<std::tuple<std::ptrdiff_t, int, int, int, btScalar, btScalar>> all;
    for (const ReportedContact& c : report(world)) {
      const auto body = std::ranges::find_if(bodies, [&](const auto& b) { return &b->body == c.b.object; });
      all.emplace_back(body - bodies.begin(), c.a.triangle.index, c.b.triangle.part, c.b.triangle.index,
                       c.distance, c.b.point.x());
      EXPECT_EQ(c.a.object, &bodies[0]->body);
    }
    return all;
  };
  const auto expected = numbers(false);
  EXPECT_GT(expected.size(), 10u);
  EXPECT_EQ(numbers(true), expected);
}

TEST(ContactReport, numbersOfSomeoneElseHaveNoBlade) {
  ClusteredOctreeShape torus = shapeOver(testing::torus(2, 0.7, 24, 12));
  BulletWorld world;
  Added fixed(world, torus, false), tool(world, torus, true);
  tool.body.setWorldTransform(at(1, 0, 0));
  world->performDiscreteCollisionDetection();
  const std::vector<int> blades(torus.tree().mesh().triangleCount(), 3);
  const BladeTable tables[] = {{&fixed.body, blades}};
  std::vector<ReportedContact> found;
  const auto bladesAreAll = [&](int blade) {
    reportContacts(world.dispatcher(), found, tables);
    return !found.empty() &&
           std::ranges::all_of(found, [blade](const auto& c) { return c.a.blade == blade; });
  };
  EXPECT_TRUE(bladesAreAll(3));
  using Number = std::pair<int, int>;
  for (const auto& [part, index] : {Number(0, 1'000'000), Number(7, 0), Number(-1, 0), Number(0, -1)}) {
    for (btManifoldPoint* point : testing::manifoldPoints(world.dispatcher())) {
      point->m_partId0 = point->m_partId1 = part;
      point->m_index0 = point->m_index1 = index;
    }
    EXPECT_TRUE(bladesAreAll(0)) << part << ' ' << index;
  }
}

TEST(ContactReport, refusesTablesOfOthers) {
  ClusteredOctreeShape torus = shapeOver(testing::torus(2, 0.7, 24, 12));
  btSphereShape ball(1);
  btCollisionObject mesh, convex;
  mesh.setCollisionShape(&torus);
  convex.setCollisionShape(&ball);
  BulletWorld world;
  std::vector<ReportedContact> found;
  const std::vector<int> right(torus.tree().mesh().triangleCount()), wrong(7);
  const auto with = [&](const btCollisionObject* object, std::span<const int> blades) {
    const BladeTable tables[] = {{object, blades}};
    reportContacts(world.dispatcher(), found, tables);
  };
  EXPECT_NO_THROW(with(&mesh, right));
  EXPECT_THROW(with(&mesh, wrong), std::invalid_argument);
  EXPECT_THROW(with(&convex, right), std::invalid_argument);
  EXPECT_THROW(with(nullptr, right), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk
