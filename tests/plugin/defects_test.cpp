// Meshes with defects act like the solids that they stand for, as the static and as the moving body.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "contact/solid_mesh.h"
#include "octoblisk/mass_properties.h"
#include "plugin/broadphase_worlds.h"
#include "shared/defective_meshes.h"
#include "shared/meshes.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::DefectiveMesh;
using testing::shapeOf;
using testing::SharedMesh;

constexpr double kFrameTime = 1.0 / 60.0;
constexpr double kBodyHalf = 0.1;    // of the small bodies
constexpr double kTargetSize = 2.4;  // targets are thicker than the way of a body at 40 m/s in a frame
constexpr double kBulletSize = 0.1;
constexpr double kSlideTime = 0.05;      // for which bodies keep their speed along a surface, in effect
constexpr double kRestTolerance = 1e-4;  // of heights

/// Over the longest edge.
double heightOf(const Triangle& triangle) {
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    longest = std::max(longest, (triangle[i] - triangle[(i + 1) % 3]).norm());
  return longest > 0.0 ? scaledNormal(triangle).norm() / longest : 0.0;
}

/// Whether a point is in the solid that a mesh stands for, by brute force.
bool isIn(const DefectiveMesh& mesh, const Vec3& point) {
  return testing::windingNumber(*mesh.clean, point) > 0.5;
}

/// What is in front of a triangle of a mesh and behind it.
struct Beside {
  bool front, back;
  bool is_inward;  ///< the mesh faces into the solid there

  Beside(const DefectiveMesh& mesh, const Triangle& triangle) {
    const Vec3 step = (3.0 * mesh.gap + 1e-7 * mesh.size()) * unitNormal(triangle);
    // Not the centroid, where triangles that overlap often have an edge.
    const Vec3 middle = 0.31 * triangle[0] + 0.28 * triangle[1] + 0.41 * triangle[2];
    front = isIn(mesh, middle + step);
    back = isIn(mesh, middle - step);
    is_inward = front && !back && testing::windingNumber(*mesh.mesh, middle + step) < 0.0;
  }
  bool isOutward() const { return !front && back; }
};

/// The meshes that face outward and stand for a solid.
std::vector<DefectiveMesh> solidOnes(const std::vector<DefectiveMesh>& all) {
  std::vector<DefectiveMesh> found;
  for (const DefectiveMesh& mesh : all) {
    if (!mesh.is_closed || !mesh.is_faithful) continue;
    bool is_inward = false;
    for (std::size_t t = 0; t < mesh.mesh->triangleCount() && !is_inward; ++t) {
      const Triangle triangle = mesh.mesh->triangle(t);
      if (heightOf(triangle) > 1e-4 * mesh.size()) is_inward = Beside(mesh, triangle).is_inward;
    }
    if (!is_inward) found.push_back(mesh);
  }
  return found;
}

DefectiveMesh scaled(const DefectiveMesh& mesh, double factor) { return moved(mesh, Pose(), factor); }

Vec3 placeOf(const btRigidBody& body) { return fromBullet(body.getWorldTransform().getOrigin()); }

Pose at(double x, double y, double z) { return {Mat3::Identity(), Vec3(x, y, z)}; }

/// Bodies meet only the first one, which is at the origin.
template <typename Broadphase>
class Range {
 public:
  explicit Range(btCollisionShape& first, double mass = 0.0, double gravity = 0.0) {
    dynamic_.broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&only_with_first_);
    dynamic_.world.setGravity(btVector3(0, 0, btScalar(-gravity)));
    dynamic_.add(first, btScalar(mass), btTransform::getIdentity());
  }

  btRigidBody& add(btCollisionShape& shape, const Pose& pose, double mass = 1.0) {
    return dynamic_.add(shape, btScalar(mass), toBullet(pose));
  }
  void step() { dynamic_.world.stepSimulation(btScalar(kFrameTime), 0); }
  void step(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }
  /// The i-th body after the first.
  const btRigidBody& body(std::size_t i) const { return *dynamic_.bodies[i + 1]; }
  btRigidBody& first() { return *dynamic_.bodies[0]; }

 private:
  struct OnlyWithFirst final : btOverlapFilterCallback {
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
      const auto isFirst = [](const btBroadphaseProxy* proxy) {
        return static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex() == 1;
      };
      return isFirst(a) != isFirst(b);
    }
  };
  OnlyWithFirst only_with_first_;
  testing::DynamicWorld<Broadphase> dynamic_;
};

/// A shot at a solid. The shortest way out of all places where the body may be after its first step in the
/// solid leads back through the plane of the triangle that it hits, even if the body slides sideways
/// meanwhile.
struct Shot {
  Vec3 entry, normal, direction;
  double start;  // the distance to the entry

  /// Whether a place is beyond the plane through which the body enters.
  bool isBehind(const Vec3& place) const { return normal.dot(place - entry) < 0.0; }
};

constexpr std::array kSpeeds = {5.0, 10.0, 20.0, 40.0};

std::vector<Shot> shotsAt(const TriangleMesh& solid, double speed, std::size_t count) {
  std::mt19937_64 random(300);
  std::vector<double> area_until;
  for (std::size_t t = 0; t < solid.triangleCount(); ++t)
    area_until.push_back((t > 0 ? area_until.back() : 0.0) + scaledNormal(solid.triangle(t)).norm());
  std::vector<Shot> shots;
  const auto isInside = [&](const Vec3& point) { return testing::windingNumber(solid, point) > 0.5; };
  for (int i = 0; i < 20000 && shots.size() < count; ++i) {
    const double area = testing::uniform(random, 0.0, area_until.back());
    const Triangle triangle =
        solid.triangle(std::size_t(std::ranges::lower_bound(area_until, area) - area_until.begin()));
    double u = testing::uniform(random, 0.0, 1.0), v = testing::uniform(random, 0.0, 1.0);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const Shot shot = {triangle[0] + u * (triangle[1] - triangle[0]) + v * (triangle[2] - triangle[0]),
                       unitNormal(triangle), testing::randomPoint(random, 1.0).normalized(),
                       testing::uniform(random, 0.5, 0.5 + speed * kFrameTime)};
    if (shot.normal.dot(shot.direction) > -0.9) continue;
    const Vec3 deepest = shot.entry + speed * kFrameTime * shot.direction;
    const double depth = shot.normal.dot(shot.entry - deepest);
    const Vec3 sideways = shot.direction - shot.normal.dot(shot.direction) * shot.normal;
    const auto leadsBack = [&](const Vec3& place) {
      return isInside(place) && testing::bruteForceDistance(solid, place) > 0.999 * depth;
    };
    if (!leadsBack(deepest) || !leadsBack(deepest + kSlideTime * speed * sideways)) continue;
    bool is_free = true;
    for (double before = kBodyHalf; before < shot.start && is_free; before += kBodyHalf)
      is_free = !isInside(shot.entry - before * shot.direction);
    if (is_free) shots.push_back(shot);
  }
  return shots;
}

/// Places well inside a solid, with one shortest way out.
std::vector<Vec3> placesIn(const TriangleMesh& solid, std::size_t count) {
  std::mt19937_64 random(302);
  std::vector<Vec3> places;
  for (int i = 0; i < 4000 && places.size() < count; ++i) {
    const Vec3 place = solid.bounds().center() +
                       testing::randomPoint(random, 1.0).cwiseProduct(solid.bounds().halfExtents());
    if (testing::windingNumber(solid, place) < 0.5) continue;
    double nearest = std::numeric_limits<double>::infinity();
    Vec3 way_out = Vec3::UnitX();
    std::vector<double> distances;
    for (std::size_t t = 0; t < solid.triangleCount(); ++t) {
      distances.push_back(testing::bruteForceDistance(solid.triangle(t), place));
      if (distances.back() >= nearest) continue;
      nearest = distances.back();
      way_out = unitNormal(solid.triangle(t));
    }
    if (nearest < 2.5 * kBodyHalf) continue;
    bool is_unique = true;
    for (std::size_t t = 0; t < solid.triangleCount(); ++t) {
      const bool is_another = unitNormal(solid.triangle(t)).dot(way_out) < 0.9;
      is_unique &= !is_another || distances[t] > nearest + kBodyHalf;
    }
    if (is_unique) places.push_back(place);
  }
  return places;
}

/// The greatest height of a mesh at x and y; none if no triangle that faces up is there.
std::optional<double> topAt(const TriangleMesh& mesh, double x, double y) {
  std::optional<double> top;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const Triangle triangle = mesh.triangle(t);
    const Vec3 facing = scaledNormal(triangle);
    if (!(facing.z() > 1e-9)) continue;
    bool is_here = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &from = triangle[i], &to = triangle[(i + 1) % 3];
      is_here &= (to.x() - from.x()) * (y - from.y()) >= (to.y() - from.y()) * (x - from.x());
    }
    if (!is_here) continue;
    const Vec3 from_corner = triangle[0] - Vec3(x, y, 0.0);
    const double height = triangle[0].z() + facing.head<2>().dot(from_corner.head<2>()) / facing.z();
    top = std::max(top.value_or(height), height);
  }
  return top;
}

/// Places on top of a solid where it is level all around.
std::vector<Vec3> levelPlaces(const TriangleMesh& solid, std::size_t count) {
  const Aabb& bounds = solid.bounds();
  std::mt19937_64 random(304);
  std::vector<Vec3> places;
  for (int i = 0; i < 1000 && places.size() < count; ++i) {
    const double x = testing::uniform(random, bounds.min.x(), bounds.max.x()),
                 y = testing::uniform(random, bounds.min.y(), bounds.max.y());
    const std::optional<double> top = topAt(solid, x, y);
    bool is_level = top.has_value();
    for (int k = 0; k < 8 && is_level; ++k) {
      const double angle = 0.01 + 0.25 * std::numbers::pi * k;
      const std::optional<double> beside =
          topAt(solid, x + 2.0 * kBodyHalf * std::cos(angle), y + 2.0 * kBodyHalf * std::sin(angle));
      is_level = beside && std::abs(*beside - *top) < 1e-9;
    }
    if (is_level) places.emplace_back(x, y, *top);
  }
  return places;
}

/// A solid that several meshes stand for, and what happens to it.
struct Target {
  SharedMesh solid;
  std::array<std::vector<Shot>, kSpeeds.size()> shots;  // per speed
  std::vector<Vec3> inside, on_top;
};

const Target& targetOf(const SharedMesh& solid) {
  static std::vector<std::unique_ptr<Target>> known;
  for (const auto& target : known) {
    if (target->solid->vertices() == solid->vertices() && target->solid->triangles() == solid->triangles())
      return *target;
  }
  known.push_back(std::make_unique<Target>());
  Target& target = *known.back();
  target.solid = solid;
  for (std::size_t i = 0; i < kSpeeds.size(); ++i) target.shots[i] = shotsAt(*solid, kSpeeds[i], 40);
  target.inside = placesIn(*solid, 8);
  target.on_top = levelPlaces(*solid, 4);
  return target;
}

template <typename T>
std::vector<T> firstOf(const std::vector<T>& all, std::size_t count) {
  return {all.begin(), all.begin() + std::ptrdiff_t(std::min(count, all.size()))};
}

struct Passed {
  int shots = 0, hits = 0, passed = 0;

  Passed& operator+=(const Passed& other) {
    shots += other.shots, hits += other.hits, passed += other.passed;
    return *this;
  }
};

/// Whether a body whose places after each step are given comes out of the solid where the shot went in: the
/// surface there faces the shot.
bool returns(const Shot& shot, const std::vector<Vec3>& places, const TriangleMesh& solid) {
  bool was_behind = false;
  for (const Vec3& place : places) {
    const bool is_behind = shot.isBehind(place);
    if (was_behind && !is_behind) return true;
    was_behind = was_behind || is_behind;
  }
  if (!was_behind) return true;
  // On a curved surface, it may have come out behind the plane of its entry.
  const auto isBehind = [&](const Vec3& place) { return shot.isBehind(place); };
  const auto isOutside = [&](const Vec3& place) { return testing::windingNumber(solid, place) < 0.5; };
  const auto out = std::find_if(std::ranges::find_if(places, isBehind), places.end(), isOutside);
  if (out == places.end()) return false;
  double nearest = std::numeric_limits<double>::infinity();
  Vec3 facing = shot.direction;
  for (std::size_t t = 0; t < solid.triangleCount(); ++t) {
    const double distance = testing::bruteForceDistance(solid.triangle(t), *out);
    if (distance >= nearest) continue;
    nearest = distance;
    facing = unitNormal(solid.triangle(t));
  }
  return facing.dot(shot.direction) < 0.0;
}

/// Shoots a body at a target, and counts how often it does not return.
template <typename Broadphase>
Passed passedOf(const std::vector<Shot>& shots, double speed, const TriangleMesh& solid,
                btCollisionShape& target, btCollisionShape& shape) {
  Range<Broadphase> range(target);
  std::mt19937_64 random(301);
  for (const Shot& shot : shots) {
    const Vec3 start = shot.entry - shot.start * shot.direction;
    btRigidBody& body = range.add(shape, {testing::randomRotation(random), start});
    body.setLinearVelocity(toBullet(Vec3(speed * shot.direction)));
    body.setActivationState(DISABLE_DEACTIVATION);
  }
  std::vector<std::vector<Vec3>> places(shots.size());
  const int steps = int(0.6 / (speed * kFrameTime)) + 30;
  for (int step = 0; step < steps; ++step) {
    range.step();
    for (std::size_t i = 0; i < shots.size(); ++i) places[i].push_back(placeOf(range.body(i)));
  }
  Passed count;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const double forward = shots[i].direction.dot(fromBullet(range.body(i).getLinearVelocity()));
    ++count.shots;
    count.hits += forward < 0.9 * speed;
    count.passed += !returns(shots[i], places[i], solid);
  }
  return count;
}

/// The same where the target flies at a body that stands still.
template <typename Broadphase>
Passed passedByTarget(const std::vector<Shot>& shots, double speed, const TriangleMesh& solid,
                      btCollisionShape& target, btCollisionShape& shape) {
  Passed count;
  for (const Shot& shot : shots) {
    Range<Broadphase> range(target, 1.0);
    const Vec3 place = shot.entry - shot.start * shot.direction;
    range.add(shape, {Mat3::Identity(), place}, 0.0);
    btRigidBody& flying = range.first();
    flying.setAngularFactor(0);  // its way out would turn as well
    flying.setLinearVelocity(toBullet(Vec3(-speed * shot.direction)));
    flying.setActivationState(DISABLE_DEACTIVATION);
    std::vector<Vec3> places;
    for (int step = 0; step < int(0.6 / (speed * kFrameTime)) + 30; ++step) {
      range.step();
      places.push_back(fromBullet(flying.getWorldTransform()).inverse() * place);
    }
    ++count.shots;
    count.hits += -shot.direction.dot(fromBullet(flying.getLinearVelocity())) < 0.9 * speed;
    count.passed += !returns(shot, places, solid);
  }
  return count;
}

/// How many bodies of a shape that start in the target are outside in the end.
template <typename Broadphase>
std::size_t thatLeave(const std::vector<Vec3>& places, const TriangleMesh& solid, btCollisionShape& target,
                      btCollisionShape& shape) {
  Range<Broadphase> range(target);
  std::mt19937_64 random(303);
  for (const Vec3& place : places)
    range.add(shape, {testing::randomRotation(random), place}).setActivationState(DISABLE_DEACTIVATION);
  std::vector<bool> are_outside;
  // Outside at some time, and still two thirds of a second later.
  for (const int steps : {80, 40}) {
    range.step(steps);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Vec3 place = placeOf(range.body(i));
      const bool is_outside = testing::windingNumber(solid, place) < 0.5 &&
                              testing::bruteForceDistance(solid, place) > 0.9 * kBodyHalf;
      if (are_outside.size() < places.size()) {
        are_outside.push_back(is_outside);
      } else {
        are_outside[i] = are_outside[i] && is_outside;
      }
    }
  }
  return std::size_t(std::ranges::count(are_outside, true));
}

/// The places of bodies that were dropped, and how many of them sleep.
struct Dropped {
  std::vector<Vec3> places;
  int asleep = 0;
};

template <typename Broadphase>
Dropped dropped(const std::vector<Vec3>& onto, btCollisionShape& target, btCollisionShape& shape) {
  Range<Broadphase> range(target, 0.0, 9.81);
  std::mt19937_64 random(305);
  for (const Vec3& place : onto) {
    const double yaw = testing::uniform(random, -3.0, 3.0);
    range.add(shape, {Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix(),
                      place + Vec3(0.0, 0.0, 2.5 * kBodyHalf)});
  }
  range.step(200);  // Bullet lets bodies sleep after two seconds
  Dropped result;
  for (std::size_t i = 0; i < onto.size(); ++i) {
    result.places.push_back(placeOf(range.body(i)));
    result.asleep += !range.body(i).isActive();
  }
  return result;
}

/// Small bodies: a box, a ball, and two meshes.
struct SmallBodies {
  btBoxShape box{toBullet(Vec3::Constant(kBodyHalf))};
  btSphereShape ball{btScalar{kBodyHalf}};
  std::unique_ptr<ClusteredOctreeShape> ring = shapeOf(testing::torus(0.1, 0.04, 16, 8)),
                                        cube = shapeOf(testing::boxMesh(Vec3::Constant(kBodyHalf)));

  std::vector<btCollisionShape*> convex() { return {&box, &ball}; }
  std::vector<btCollisionShape*> all() { return {&box, &ball, ring.get(), cube.get()}; }
};

template <typename Broadphase>
class Defects : public ::testing::Test {};

using BothBroadphases = ::testing::Types<btDbvtBroadphase, ClusteredOctreeBroadphase>;

struct NamesOfBoth {
  template <typename Broadphase>
  static std::string GetName(int index) {
    return index == 0 ? "dbvt" : "clusters";
  }
};

TYPED_TEST_SUITE(Defects, BothBroadphases, NamesOfBoth);

TYPED_TEST(Defects, whatIsInsideComesOut) {
  SmallBodies bodies;
  std::size_t starts = 0;
  for (const DefectiveMesh& raw : solidOnes(testing::defectiveMeshes())) {
    const DefectiveMesh mesh = scaled(raw, kTargetSize);
    const auto shape = shapeOf(mesh.mesh);
    const std::vector<Vec3>& places = targetOf(mesh.clean).inside;
    starts += places.size();
    for (btCollisionShape* const body : bodies.all()) {
      EXPECT_EQ(thatLeave<TypeParam>(places, *mesh.clean, *shape, *body), places.size())
          << mesh.name << ' ' << body->getName();
    }
  }
  EXPECT_GT(starts, 250u);
}

TYPED_TEST(Defects, bodiesRestOnThemAsOnTheSolid) {
  SmallBodies bodies;
  int tested = 0;
  for (const DefectiveMesh& raw : solidOnes(testing::defectiveMeshes())) {
    const DefectiveMesh mesh = scaled(raw, kTargetSize);
    const std::vector<Vec3>& places = targetOf(mesh.clean).on_top;
    if (places.empty()) continue;
    ++tested;
    const auto target = shapeOf(mesh.mesh), solid = shapeOf(mesh.clean);
    for (btCollisionShape* const shape : bodies.all()) {
      const Dropped found = dropped<TypeParam>(places, *target, *shape),
                    expected = dropped<TypeParam>(places, *solid, *shape);
      const auto all = int(places.size());
      EXPECT_EQ(found.asleep, all) << mesh.name << ' ' << shape->getName();
      EXPECT_EQ(expected.asleep, all) << mesh.name << ' ' << shape->getName();
      for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_NEAR(found.places[i].z(), expected.places[i].z(), kRestTolerance + mesh.gap)
            << mesh.name << ' ' << shape->getName();
        EXPECT_GT(expected.places[i].z(), places[i].z() + 0.04);
        EXPECT_LT((found.places[i] - places[i]).template head<2>().norm(), 0.01) << mesh.name;
      }
    }
  }
  EXPECT_GT(tested, 18);
}

/// Expects that nothing passes, and that all shots change the body's way.
void expectAllBack(const Passed& count, const std::string& what) {
  EXPECT_EQ(count.passed, 0) << what;
  EXPECT_EQ(count.hits, count.shots) << what;
}

/// A small copy of a mesh, around its middle.
DefectiveMesh bulletOf(const DefectiveMesh& mesh) {
  const Vec3 middle = kBulletSize * mesh.mesh->bounds().center();
  return moved(mesh, {Mat3::Identity(), -middle}, kBulletSize);
}

TYPED_TEST(Defects, whatIsShotAtThemComesBack) {
  btBoxShape box(toBullet(Vec3::Constant(kBodyHalf)));
  Passed all;
  const Target* last = nullptr;
  for (const DefectiveMesh& raw : solidOnes(testing::defectiveMeshes())) {
    const DefectiveMesh mesh = scaled(raw, kTargetSize);
    const Target& target = targetOf(mesh.clean);
    const bool is_new = std::exchange(last, &target) != &target;
    const auto shape = shapeOf(mesh.mesh), solid = shapeOf(mesh.clean), bullet = shapeOf(bulletOf(raw).mesh);
    for (std::size_t i = 0; i < kSpeeds.size(); ++i) {
      const std::vector<Shot>& shots = target.shots[i];
      const std::string what = mesh.name + " at " + std::to_string(kSpeeds[i]);
      const auto passed = [&](const std::vector<Shot>& of, btCollisionShape& at, btCollisionShape& body) {
        return passedOf<TypeParam>(of, kSpeeds[i], *mesh.clean, at, body);
      };
      const Passed count = passed(shots, *shape, box);
      expectAllBack(count, what);
      all += count;
      if (is_new) expectAllBack(passed(shots, *solid, box), what + ", solid");
      expectAllBack(passed(firstOf(shots, 10), *shape, *bullet), what + ", by itself");
    }
  }
  EXPECT_GT(all.shots, 4500);
}

TYPED_TEST(Defects, theyComeBackWhenTheyAreShot) {
  const Vec3 half(3.0, 3.0, 1.0);
  const SharedMesh block = testing::boxMesh(half);
  const auto mesh_block = shapeOf(block);
  btBoxShape box_block(toBullet(half));
  for (const DefectiveMesh& raw : solidOnes(testing::defectiveMeshes())) {
    const auto bullet = shapeOf(bulletOf(raw).mesh);
    for (std::size_t i = 0; i < kSpeeds.size(); ++i) {
      const std::vector<Shot>& shots = targetOf(block).shots[i];
      ASSERT_EQ(shots.size(), 40u);
      const std::string what = raw.name + " at " + std::to_string(kSpeeds[i]);
      const std::size_t count = kSpeeds[i] < 40.0 ? 10 : 40;
      expectAllBack(passedOf<TypeParam>(firstOf(shots, count), kSpeeds[i], *block, *mesh_block, *bullet),
                    what);
      // At 40 m/s, one in 40 passes a btBoxShape, also of boxes without defects.
      if (kSpeeds[i] == 20.0)
        expectAllBack(passedOf<TypeParam>(firstOf(shots, 20), kSpeeds[i], *block, box_block, *bullet),
                      what + ", convex");
    }
  }
}

TYPED_TEST(Defects, theyDoNotPassOverWhatStandsStill) {
  SmallBodies bodies;
  for (const DefectiveMesh& raw : solidOnes(testing::defectiveMeshes())) {
    const DefectiveMesh mesh = scaled(raw, kTargetSize);
    const auto shape = shapeOf(mesh.mesh);
    for (std::size_t i = 0; i < kSpeeds.size(); ++i) {
      const std::vector<Shot> shots = firstOf(targetOf(mesh.clean).shots[i], 5);
      for (btCollisionShape* const body :
           {static_cast<btCollisionShape*>(&bodies.box), static_cast<btCollisionShape*>(bodies.cube.get())}) {
        expectAllBack(passedByTarget<TypeParam>(shots, kSpeeds[i], *mesh.clean, *shape, *body),
                      mesh.name + " over a " + body->getName() + " at " + std::to_string(kSpeeds[i]));
      }
    }
  }
}

/// The mesh moves off a body that does not move.
TYPED_TEST(Defects, theyLeaveWhatIsInThem) {
  SmallBodies bodies;
  int tested = 0;
  for (const DefectiveMesh& raw : solidOnes(testing::defectiveMeshes())) {
    const DefectiveMesh mesh = scaled(raw, kTargetSize);
    const auto moving = shapeOf(mesh.mesh);
    for (const Vec3& place : firstOf(targetOf(mesh.clean).inside, 2)) {
      for (btCollisionShape* const shape : bodies.all()) {
        Range<TypeParam> range(*moving, 1.0);
        range.add(*shape, {Mat3::Identity(), place}, 0.0);
        range.step(120);
        const Vec3 in_mesh = fromBullet(range.first().getWorldTransform()).inverse() * place;
        EXPECT_LT(testing::windingNumber(*mesh.clean, in_mesh), 0.5) << mesh.name << ' ' << shape->getName();
        EXPECT_GT(testing::bruteForceDistance(*mesh.clean, in_mesh), 0.9 * kBodyHalf)
            << mesh.name << ' ' << shape->getName();
        ++tested;
      }
    }
  }
  EXPECT_GT(tested, 200);
}

TYPED_TEST(Defects, theyRestOnAFloorAsTheSolidDoes) {
  const Vec3 half(5.0, 5.0, 0.5);
  const std::vector<Vec3> places = {Vec3(1.0, 1.0, 0.5), Vec3(-1.3, 0.7, 0.5), Vec3(-0.4, -2.1, 0.5)};
  const auto mesh_floor = shapeOf(testing::boxMesh(half));
  btBoxShape box_floor(toBullet(half));
  for (const DefectiveMesh& raw : solidOnes(testing::defectiveMeshes())) {
    if (targetOf(scaled(raw, kTargetSize).clean).on_top.empty()) continue;  // it would roll
    const DefectiveMesh mesh = bulletOf(raw);
    const auto body = shapeOf(mesh.mesh), solid = shapeOf(mesh.clean);
    const double thicker = double(body->getMargin() - solid->getMargin());
    for (btCollisionShape* const floor :
         {static_cast<btCollisionShape*>(mesh_floor.get()), static_cast<btCollisionShape*>(&box_floor)}) {
      const Dropped found = dropped<TypeParam>(places, *floor, *body),
                    expected = dropped<TypeParam>(places, *floor, *solid);
      EXPECT_EQ(found.asleep, 3) << mesh.name << ' ' << floor->getName();
      EXPECT_EQ(expected.asleep, 3) << mesh.name << ' ' << floor->getName();
      for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_NEAR(found.places[i].z(), expected.places[i].z() + thicker, kRestTolerance + mesh.gap)
            << mesh.name << ' ' << floor->getName();
        EXPECT_GT(expected.places[i].z(), places[i].z() + 0.04);
      }
    }
  }
}

/// Two defects in one mesh.
TYPED_TEST(Defects, ofTwoKindsAtOnce) {
  btBoxShape box(toBullet(Vec3::Constant(kBodyHalf)));
  int meshes = 0;
  std::size_t starts = 0;
  for (const DefectiveMesh& raw : solidOnes(testing::twiceDefectiveMeshes())) {
    ++meshes;
    const DefectiveMesh mesh = scaled(raw, kTargetSize);
    const Target& target = targetOf(mesh.clean);
    const auto shape = shapeOf(mesh.mesh);
    EXPECT_TRUE(shape->isSolid()) << mesh.name;
    const std::vector<Vec3> places = firstOf(target.inside, 3);
    starts += places.size();
    EXPECT_EQ(thatLeave<TypeParam>(places, *mesh.clean, *shape, box), places.size()) << mesh.name;
    const std::vector<Shot> shots = firstOf(target.shots[2], 10);
    expectAllBack(passedOf<TypeParam>(shots, kSpeeds[2], *mesh.clean, *shape, box), mesh.name);
  }
  EXPECT_GT(meshes, 80);
  EXPECT_GT(starts, 250u);
}

TEST(DefectsOfShapes, solidsHaveMarginAndInertia) {
  for (const DefectiveMesh& raw : solidOnes(testing::defectiveMeshes())) {
    for (const double size : {kBulletSize, kTargetSize}) {
      const DefectiveMesh mesh = scaled(raw, size);
      const auto shape = shapeOf(mesh.mesh), solid = shapeOf(mesh.clean);
      EXPECT_TRUE(shape->isSolid()) << mesh.name;
      EXPECT_TRUE(solid->isSolid()) << mesh.name;
      EXPECT_TRUE(shape->solid().isAnywhereSolid()) << mesh.name;
      if ((mesh.mesh->bounds().halfExtents() - mesh.clean->bounds().halfExtents()).norm() <
          10.0 * mesh.gap + 1e-9) {
        EXPECT_NEAR(double(shape->getMargin()), double(solid->getMargin()), 0.1 * mesh.gap + 1e-6 * size)
            << mesh.name;
      }
      EXPECT_GT(shape->getMargin(), 0.0) << mesh.name;
      btVector3 inertia;
      shape->calculateLocalInertia(2, inertia);
      const testing::Moments moments = mesh.moments();
      const Mat3 about_origin = moments.inertia + (moments.center.squaredNorm() * Mat3::Identity() -
                                                   moments.center * moments.center.transpose());
      const Vec3 expected = 2.0 * about_origin.diagonal();
      EXPECT_LT((fromBullet(inertia) - expected).norm(), (1e-6 + 10.0 * mesh.gap / size) * expected.norm())
          << mesh.name;
    }
  }
}

TEST(DefectsOfShapes, othersAreNoSolids) {
  int others = 0;
  for (const DefectiveMesh& mesh : testing::defectiveMeshes()) {
    const bool faces_inward = mesh.name.ends_with("inside out");
    if (mesh.is_closed && !faces_inward) continue;
    ++others;
    const auto shape = shapeOf(mesh.mesh);
    EXPECT_FALSE(shape->isSolid()) << mesh.name;
    // The ball lacks one of its smallest facets, and the bottle encloses space on both of its "sides".
    const bool is_partly_solid = mesh.name == "ball with a missing facet" || mesh.name == "a Klein bottle";
    EXPECT_EQ(shape->solid().isAnywhereSolid(), is_partly_solid) << mesh.name;
    EXPECT_EQ(shape->getMargin() > 0, is_partly_solid) << mesh.name;
    btVector3 inertia;
    shape->calculateLocalInertia(1, inertia);
    EXPECT_GT(inertia[inertia.minAxis()], 0) << mesh.name;
  }
  EXPECT_GE(others, 9);
}

/// Only those triangles push bodies out whose back is inside and whose front is outside.
TEST(DefectsOfShapes, trianglesBoundSolids) {
  int bounding = 0, inward = 0, unlike = 0;
  for (const DefectiveMesh& mesh : testing::defectiveMeshes()) {
    if (!mesh.is_closed || !mesh.is_faithful) continue;
    const auto shape = shapeOf(mesh.mesh);
    const detail::SolidMesh solid = shape->solid();
    const TriangleMesh& boundary = solid.boundary().mesh();
    const double size = mesh.size();
    std::map<std::uint32_t, std::vector<bool>> parts;  // per triangle of the mesh: whether they are outward
    for (std::uint32_t t = 0; t < boundary.triangleCount(); ++t) {
      const Triangle triangle = boundary.triangle(t);
      const Triangle source = mesh.mesh->triangle(solid.sourceOf(t));
      for (const Vec3& corner : triangle) {
        EXPECT_LT(testing::bruteForceDistance(source, corner), 1e-9 * size) << mesh.name << ' ' << t;
      }
      if (heightOf(triangle) < 1e-5 * size + 10.0 * mesh.gap) continue;
      const Beside beside(mesh, triangle);
      EXPECT_FALSE(beside.front && beside.back) << mesh.name << ' ' << t;
      parts[solid.sourceOf(t)].push_back(beside.isOutward());
      bounding += beside.isOutward();
      inward += beside.is_inward;
    }
    for (std::uint32_t t = 0; t < boundary.triangleCount(); ++t) {
      const auto found = parts.find(solid.sourceOf(t));
      if (found == parts.end()) continue;
      const std::vector<bool>& are_outward = found->second;
      // A triangle has one role, even if one part of it faces into a solid and another out of one.
      if (std::ranges::count(are_outward, are_outward[0]) < std::ssize(are_outward)) {
        ++unlike;
      } else {
        EXPECT_EQ(solid.boundsSolid(t), are_outward[0]) << mesh.name << ' ' << t;
      }
    }
  }
  EXPECT_GT(bounding, 2000);
  EXPECT_GT(inward, 100);
  EXPECT_LT(unlike, 100);
}

/// Near the hole, triangles are sheets. The others bound the solid.
TEST(DefectsOfShapes, aHoleMakesSheetsNearIt) {
  for (const DefectiveMesh& mesh : testing::defectiveMeshes()) {
    if (mesh.name != "ball with a missing facet") continue;
    const auto shape = shapeOf(mesh.mesh);
    const detail::SolidMesh solid = shape->solid();
    const Triangle missing = mesh.clean->triangle(0);
    const double width = (missing[0] - missing[1]).norm();
    int near = 0, far = 0;
    for (std::uint32_t t = 0; t < solid.boundary().mesh().triangleCount(); ++t) {
      const Triangle triangle = solid.boundary().mesh().triangle(t);
      const double distance = testing::bruteForceDistance(missing, centroidOf(triangle));
      const auto isCorner = [&](const Vec3& corner) {
        return std::ranges::find(missing, corner) != missing.end();
      };
      if (std::ranges::count_if(triangle, isCorner) == 2) {
        ++near;
        EXPECT_FALSE(solid.boundsSolid(t)) << t;
      } else if (distance > 3.0 * width) {
        ++far;
        EXPECT_TRUE(solid.boundsSolid(t)) << t;
      }
    }
    EXPECT_EQ(near, 3);
    EXPECT_GT(far, 30);
  }
}

SharedMesh withoutTriangles(const TriangleMesh& mesh, FunctionRef<bool(const Vec3& centroid)> is_left_out) {
  std::vector<TriangleMesh::Indices> kept;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (!is_left_out(centroidOf(mesh.triangle(t)))) kept.push_back(mesh.triangles()[t]);
  }
  return std::make_shared<const TriangleMesh>(mesh.vertices(), std::move(kept));
}

/// Two blades on a hub: as a solid; and without the ends of the hub and the blades' faces inside it.
struct BladedHub {
  static constexpr double kRadius = 1.0, kHalfHeight = 1.5;
  static constexpr double kThick = 0.5, kHigh = 0.6;  // half extents of the blades

  SharedMesh whole, open;

  BladedHub() {
    const SharedMesh hub = shapes::cylinder(kRadius, kHalfHeight, 24);
    const SharedMesh blade =
        testing::moved(*testing::boxMesh({1.3, kThick, kHigh}), {Mat3::Identity(), Vec3(2.0, 0.0, 0.1)});
    const Pose turn{Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ()).toRotationMatrix(), Vec3::Zero()};
    const SharedMesh open_hub =
        withoutTriangles(*hub, [](const Vec3& c) { return std::abs(c.z()) > 0.99 * kHalfHeight; });
    const SharedMesh open_blade = withoutTriangles(*blade, [](const Vec3& c) { return c.x() < 0.8; });
    whole = testing::joined(*testing::joined(*hub, *blade), *testing::moved(*blade, turn));
    open = testing::joined(*testing::joined(*open_hub, *open_blade), *testing::moved(*open_blade, turn));
  }
  DefectiveMesh defective() const { return {.name = "blades on a hub", .mesh = open, .clean = whole}; }
};

TEST(DefectsOfShapes, bladesOnAnOpenHubAreSolid) {
  const BladedHub rotor;
  const auto shape = shapeOf(rotor.open), whole = shapeOf(rotor.whole);
  EXPECT_TRUE(whole->isSolid());
  EXPECT_FALSE(shape->isSolid());
  EXPECT_EQ(shape->getMargin(), whole->getMargin());
  const detail::SolidMesh solid = shape->solid();
  int of_blades = 0, of_hub = 0;
  for (std::uint32_t t = 0; t < solid.boundary().mesh().triangleCount(); ++t) {
    const Vec3 centroid = centroidOf(solid.boundary().mesh().triangle(t));
    const bool is_of_blade = centroid.head<2>().norm() > BladedHub::kRadius;
    EXPECT_EQ(solid.boundsSolid(t), is_of_blade) << t << ": " << centroid.transpose();
    ++(is_of_blade ? of_blades : of_hub);
  }
  EXPECT_GE(of_blades, 18);
  EXPECT_GE(of_hub, 40);
}

TYPED_TEST(Defects, bladesPushOutAndTheirHubIsASheet) {
  SmallBodies bodies;
  const DefectiveMesh rotor = BladedHub().defective();
  const auto target = shapeOf(rotor.mesh);
  const std::vector<Vec3> in_blades = {Vec3(2.2, 0.2, 0.1), Vec3(2.7, -0.15, -0.1), Vec3(1.6, -0.2, 0.2),
                                       Vec3(-2.3, 0.2, 0.0), Vec3(-1.7, 0.1, 0.2)};
  const std::vector<Vec3> in_bore = {Vec3(0.0, 0.0, 0.0), Vec3(0.3, 0.4, 0.9), Vec3(-0.2, 0.7, -0.7),
                                     Vec3(0.1, -0.5, 1.3)};
  for (btCollisionShape* const shape : bodies.all()) {
    EXPECT_EQ(thatLeave<TypeParam>(in_blades, *rotor.clean, *target, *shape), in_blades.size())
        << shape->getName();
    Range<TypeParam> range(*target);
    for (const Vec3& place : in_bore) range.add(*shape, {Mat3::Identity(), place});
    range.step(60);
    for (std::size_t i = 0; i < in_bore.size(); ++i) {
      EXPECT_LT((placeOf(range.body(i)) - in_bore[i]).norm(), 1e-6) << shape->getName() << ' ' << i;
    }
  }
}

/// From the bore, bodies reach the hub, and stay inside.
TYPED_TEST(Defects, theBoreOfAnOpenHubHoldsBodies) {
  SmallBodies bodies;
  const DefectiveMesh rotor = BladedHub().defective();
  const auto target = shapeOf(rotor.mesh);
  for (btCollisionShape* const shape : bodies.all()) {
    Range<TypeParam> range(*target);
    for (int i = 0; i < 12; ++i) {
      const double angle = (i % 2 + 0.36 + 0.025 * i) * std::numbers::pi;  // not towards a blade
      btRigidBody& body = range.add(*shape, {Mat3::Identity(), Vec3(0.0, 0.0, 0.1 * (i - 6))});
      body.setLinearVelocity(toBullet(Vec3(1.0 * std::cos(angle), 1.0 * std::sin(angle), 0.0)));
    }
    std::array<double, 12> greatest{};
    for (int step = 0; step < 120; ++step) {
      range.step();
      for (std::size_t i = 0; i < 12; ++i)
        greatest[i] = std::max(greatest[i], placeOf(range.body(i)).template head<2>().norm());
    }
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_LT(placeOf(range.body(i)).template head<2>().norm(), BladedHub::kRadius)
          << shape->getName() << ' ' << i;
      EXPECT_GT(greatest[i], 0.5) << shape->getName() << ' ' << i;
    }
  }
}

TYPED_TEST(Defects, whatIsShotAtBladesComesBack) {
  btBoxShape box(toBullet(Vec3::Constant(kBodyHalf)));
  const DefectiveMesh rotor = BladedHub().defective();
  const auto target = shapeOf(rotor.mesh), whole = shapeOf(rotor.clean);
  std::mt19937_64 random(306);
  for (const double speed : {5.0, 10.0, 20.0}) {
    std::vector<Shot> shots;
    for (int i = 0; i < 40; ++i) {
      const double side = i % 2 == 0 ? 1.0 : -1.0, end = i % 4 < 2 ? 1.0 : -1.0;
      const Vec3 entry(end * testing::uniform(random, 1.6, 2.8), side * BladedHub::kThick,
                       testing::uniform(random, -0.2, 0.4));
      const Vec3 aside(testing::uniform(random, -0.2, 0.2), 0.0, testing::uniform(random, -0.2, 0.2));
      shots.push_back({entry, side * Vec3::UnitY(), (aside - side * Vec3::UnitY()).normalized(),
                       testing::uniform(random, 0.5, 0.5 + speed * kFrameTime)});
    }
    expectAllBack(passedOf<TypeParam>(shots, speed, *rotor.clean, *whole, box),
                  "whole at " + std::to_string(speed));
    expectAllBack(passedOf<TypeParam>(shots, speed, *rotor.clean, *target, box),
                  "open at " + std::to_string(speed));
  }
}

/// Whoever gets from the bore into a blade, through its missing face, is inside a solid.
TYPED_TEST(Defects, bladesAlsoPushOutWhatComesFromTheBore) {
  SmallBodies bodies;
  const DefectiveMesh rotor = BladedHub().defective();
  const auto target = shapeOf(rotor.mesh);
  for (btCollisionShape* const shape : bodies.convex()) {
    Range<TypeParam> range(*target);
    for (int i = 0; i < 8; ++i) {
      const double side = i % 2 == 0 ? 1.0 : -1.0;
      btRigidBody& body = range.add(*shape, {Mat3::Identity(), Vec3(0.0, 0.06 * (i - 3.5), 0.05 * i)});
      body.setLinearVelocity(toBullet(Vec3(3.0 * side, 0.0, 0.0)));
    }
    range.step(60);
    for (std::size_t i = 0; i < 8; ++i) {
      const Vec3 place = placeOf(range.body(i));
      const bool is_in_blade = isIn(rotor, place) && place.template head<2>().norm() > BladedHub::kRadius;
      EXPECT_FALSE(is_in_blade) << shape->getName() << ' ' << i << ": " << place.transpose();
    }
  }
}

/// A ball without one facet is a solid elsewhere.
TYPED_TEST(Defects, aHoleChangesNothingFarAway) {
  SmallBodies bodies;
  std::mt19937_64 random(310);
  const SharedMesh solid = testing::bumpySphere(random, kTargetSize, 0.0, 20);
  const Vec3 hole = centroidOf(solid->triangle(0));
  const auto shape = shapeOf(withoutTriangles(*solid, [&](const Vec3& c) { return c == hole; }));
  EXPECT_FALSE(shape->isSolid());
  Target target = targetOf(solid);
  const auto isNear = [&](const Vec3& place) { return hole.dot(place) > 0.5 * hole.squaredNorm(); };
  std::erase_if(target.inside, isNear);
  EXPECT_GE(target.inside.size(), 4u);
  for (btCollisionShape* const body : bodies.all()) {
    EXPECT_EQ(thatLeave<TypeParam>(target.inside, *solid, *shape, *body), target.inside.size())
        << body->getName();
  }
  for (std::size_t i = 0; i < kSpeeds.size(); ++i) {
    std::vector<Shot>& shots = target.shots[i];
    std::erase_if(shots, [&](const Shot& shot) { return isNear(shot.entry); });
    EXPECT_GE(shots.size(), 20u);
    expectAllBack(passedOf<TypeParam>(shots, kSpeeds[i], *solid, *shape, bodies.box),
                  std::to_string(kSpeeds[i]));
  }
}

/// A box of five faces is a sheet, whichever way it faces. Boxes and balls in it stay there, and rest on its
/// bottom.
TYPED_TEST(Defects, anOpenBoxHoldsBodies) {
  SmallBodies bodies;
  const SharedMesh box =
      withoutTriangles(*testing::boxMesh({1, 1, 1}), [](const Vec3& c) { return c.z() > 0.9; });
  for (const SharedMesh& mesh : {box, testing::insideOut(*box), testing::joined(*box, *box)}) {
    const auto target = shapeOf(mesh);
    EXPECT_FALSE(target->isSolid());
    EXPECT_FALSE(target->solid().isAnywhereSolid());
    EXPECT_EQ(target->getMargin(), 0.0);
    for (btCollisionShape* const shape : bodies.convex()) {
      Range<TypeParam> range(*target, 0.0, 9.81);
      std::mt19937_64 random(307);
      for (int i = 0; i < 12; ++i) {
        const Vec3 place(0.2 * (i % 4 - 1.5), 0.25 * (i / 4 - 1), -0.2);
        const Vec3 velocity = testing::randomPoint(random, 3.0);
        range.add(*shape, {Mat3::Identity(), place}).setLinearVelocity(toBullet(velocity));
      }
      range.step(240);
      for (std::size_t i = 0; i < 12; ++i) {
        const Vec3 place = placeOf(range.body(i));
        EXPECT_LT(place.template head<2>().cwiseAbs().maxCoeff(), 1.0) << shape->getName() << ' ' << i;
        EXPECT_NEAR(place.z(), -1.0 + kBodyHalf, 1e-3) << shape->getName() << ' ' << i;
      }
    }
  }
}

TYPED_TEST(Defects, aBowlHoldsBodies) {
  SmallBodies bodies;
  std::mt19937_64 random(308);
  const SharedMesh sphere = testing::bumpySphere(random, 1.0, 0.0, 24);
  const SharedMesh bowl = withoutTriangles(*sphere, [](const Vec3& c) { return c.z() > 0.0; });
  for (const SharedMesh& mesh : {bowl, testing::insideOut(*bowl)}) {
    const auto target = shapeOf(mesh);
    EXPECT_FALSE(target->solid().isAnywhereSolid());
    for (btCollisionShape* const shape : bodies.convex()) {
      Range<TypeParam> range(*target, 0.0, 9.81);
      for (int i = 0; i < 12; ++i) {
        const Vec3 place(0.2 * (i % 4 - 1.5), 0.25 * (i / 4 - 1), -0.5);
        range.add(*shape, {Mat3::Identity(), place});
      }
      range.step(240);
      for (std::size_t i = 0; i < 12; ++i) {
        const Vec3 place = placeOf(range.body(i));
        EXPECT_LT(place.norm(), 1.0) << shape->getName() << ' ' << i;
        EXPECT_LT(place.z(), -0.6) << shape->getName() << ' ' << i;
      }
    }
  }
}

/// A box of the bounds ±1 whose faces are divided like walls of bricks around a square: each stone ends in
/// the middle of others. So no edge has a partner.
SharedMesh brickBox() {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  constexpr double kIn = 0.3;
  constexpr std::array<std::array<double, 4>, 5> kStones = {{{-1.0, -1.0, -kIn, kIn},
                                                             {-kIn, -1.0, 1.0, -kIn},
                                                             {kIn, -kIn, 1.0, 1.0},
                                                             {-1.0, kIn, kIn, 1.0},
                                                             {-kIn, -kIn, kIn, kIn}}};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      for (const auto& [u0, v0, u1, v1] : kStones) {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        for (const auto& [u, v] : {std::pair(u0, v0), {u1, v0}, {u1, v1}, {u0, v1}}) {
          Vec3& corner = vertices.emplace_back();
          corner[axis] = side;
          corner[(axis + 1) % 3] = u;
          corner[(axis + 2) % 3] = v;
        }
        const std::uint32_t second = side > 0.0 ? 1 : 3, fourth = side > 0.0 ? 3 : 1;
        triangles.push_back({first, first + second, first + 2});
        triangles.push_back({first, first + 2, first + fourth});
      }
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

TEST(DefectsOfShapes, aBoxOfBricksIsASolid) {
  std::mt19937_64 random(309);
  const SharedMesh bricks = brickBox();
  for (int i = 0; i < 10; ++i) {
    const Pose pose = i == 0 ? Pose() : testing::randomPose(random, 3.0);
    const auto shape = shapeOf(testing::moved(*bricks, pose));
    EXPECT_TRUE(shape->isSolid()) << i;
    EXPECT_NEAR(double(shape->getMargin()), 0.01, 1e-6) << i;
    EXPECT_NEAR(shape->massProperties().volume, 8.0, 1e-9) << i;
    for (std::uint32_t t = 0; t < shape->solid().boundary().mesh().triangleCount(); ++t)
      EXPECT_TRUE(shape->solid().boundsSolid(t)) << i << ' ' << t;
  }
}

/// A shape that is fitted to other vertices is like a new one.
TEST(DefectsOfShapes, refitExaminesTheMeshAgain) {
  const SharedMesh mesh = testing::joined(*testing::boxMesh({1, 1, 1}),
                                          *testing::moved(*testing::boxMesh({1, 1, 1}), at(0.5, 0.5, 0.5)));
  const SharedMesh flat = testing::deformed(*mesh, [](const Vec3& v) { return Vec3(v.x(), v.y(), 0.0); });
  const auto shape = shapeOf(flat);
  EXPECT_FALSE(shape->isSolid());
  EXPECT_NE(shape->whyNotSolid(), "");
  shape->refit(mesh);
  const auto expected = shapeOf(mesh);
  EXPECT_TRUE(shape->isSolid());
  EXPECT_EQ(shape->getMargin(), expected->getMargin());
  EXPECT_EQ(shape->massProperties().volume, expected->massProperties().volume);
}

/// setSolid changes the triangles that bodies touch, also while a body rests on the mesh.
TEST(DefectsOfShapes, setSolidOfAMeshWithAHole) {
  const SharedMesh floor = testing::joined(
      *testing::joined(*testing::boxMesh({2, 2, 1}),
                       *testing::moved(*testing::boxMesh({1, 1, 1}), at(0, 0, -0.3))),
      *testing::moved(
          *withoutTriangles(*testing::boxMesh({1, 1, 1}), [](const Vec3& c) { return c.z() > 0.9; }),
          at(5, 0, 0)));
  const auto shape = shapeOf(floor);
  EXPECT_FALSE(shape->isSolid());
  EXPECT_NE(shape->solid().boundary().mesh().triangleCount(), floor->triangleCount());
  Range<btDbvtBroadphase> range(*shape, 0.0, 9.81);
  const auto body = shapeOf(testing::boxMesh(Vec3::Constant(kBodyHalf)));
  range.add(*body, at(0.3, 0.2, 1.0 + kBodyHalf + 0.02)).setActivationState(DISABLE_DEACTIVATION);
  for (const bool is_solid : {true, false, true, false}) {
    shape->setSolid(is_solid);
    range.step(60);
    EXPECT_NEAR(placeOf(range.body(0)).z(), 1.0 + kBodyHalf, 0.03);
  }
}

TYPED_TEST(Defects, aBoxOfBricksPushesOut) {
  btBoxShape box(toBullet(Vec3::Constant(kBodyHalf)));
  const SharedMesh solid = testing::boxMesh({1, 1, 1});
  const auto shape = shapeOf(brickBox());
  const Target& target = targetOf(solid);
  EXPECT_EQ(thatLeave<TypeParam>(target.inside, *solid, *shape, box), target.inside.size());
  for (std::size_t i = 0; i < kSpeeds.size(); ++i) {
    EXPECT_GE(target.shots[i].size(), 10u) << kSpeeds[i];
    expectAllBack(passedOf<TypeParam>(target.shots[i], kSpeeds[i], *solid, *shape, box),
                  std::to_string(kSpeeds[i]));
  }
}

/// Two boxes with a common face, apart from rounding. Each alone would push a body towards the other.
TYPED_TEST(Defects, boxesThatTouchWithinRoundingAreOneSolid) {
  SmallBodies bodies;
  const SharedMesh lower = testing::boxMesh({1.0, 1.0, 1.0});
  const SharedMesh solid =
      testing::moved(*testing::boxMesh({1.0, 1.0, 1.9}), {Mat3::Identity(), Vec3(0.0, 0.0, 0.9)});
  for (const double gap : {0.0, 1e-14, -1e-14}) {
    const SharedMesh upper =
        testing::moved(*testing::boxMesh({1.0, 1.0, 0.9}), {Mat3::Identity(), Vec3(0.0, 0.0, 1.9 + gap)});
    const auto shape = shapeOf(testing::joined(*lower, *upper));
    EXPECT_TRUE(shape->isSolid());
    const std::vector<Vec3> places = {Vec3(0.2, 0.1, 0.7), Vec3(0.3, 0.2, 0.8), Vec3(-0.2, 0.3, 1.3)};
    for (btCollisionShape* const body : bodies.all()) {
      EXPECT_EQ(thatLeave<TypeParam>(places, *solid, *shape, *body), places.size())
          << gap << ' ' << body->getName();
    }
  }
}

}  // namespace
}  // namespace octoblisk
