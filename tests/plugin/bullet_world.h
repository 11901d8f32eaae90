// Headless Bullet worlds for tests, and their queries.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "gallery/bullet_mesh.h"
#include "gallery/bullet_world.h"
#include "octoblisk/contact.h"
#include "shared/meshes.h"

namespace octoblisk::testing {

using gallery::at;
using gallery::BulletMesh;
using gallery::BulletWorld;

/// A kind of shape for a parameterized test.
struct NamedConvex {
  const char* name;
  std::function<std::unique_ptr<btConvexShape>()> make;
};

/// The hull of random points on a sphere.
inline std::unique_ptr<btConvexShape> roundHull(std::uint64_t seed, int points, double radius) {
  std::mt19937_64 random(seed);
  auto hull = std::make_unique<btConvexHullShape>();
  for (int i = 0; i < points; ++i) hull->addPoint(toBullet(radius * randomPoint(random, 1.0).normalized()));
  return hull;
}

/// The points of all manifolds.
inline std::vector<btManifoldPoint*> manifoldPoints(btDispatcher& dispatcher) {
  std::vector<btManifoldPoint*> points;
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    for (int p = 0; p < manifold.getNumContacts(); ++p) points.push_back(&manifold.getContactPoint(p));
  }
  return points;
}

/// Collects the points that contactPairTest reports.
struct PairReport final : btCollisionWorld::ContactResultCallback {
  struct Point {
    Vec3 on_a, on_b, normal;
    double distance;
    int part0, index0, part1, index1;
  };
  std::vector<Point> points;

  btScalar addSingleResult(btManifoldPoint& p, const btCollisionObjectWrapper*, int part0, int index0,
                           const btCollisionObjectWrapper*, int part1, int index1) override {
    points.push_back({fromBullet(p.m_positionWorldOnA), fromBullet(p.m_positionWorldOnB),
                      fromBullet(p.m_normalWorldOnB), double(p.m_distance1), part0, index0, part1, index1});
    return 0;
  }

  /// The contacts of two bodies without their margins, in the first one's frame. The parts are left out.
  std::vector<Contact> contacts(const Pose& first_in_world, double margin0, double margin1) const {
    std::vector<Contact> all;
    for (const Point& p : points) {
      all.push_back({first_in_world.inverse() * (p.on_a + margin0 * p.normal),
                     first_in_world.inverse() * (p.on_b - margin1 * p.normal),
                     first_in_world.rotation.transpose() * p.normal, p.distance + margin0 + margin1,
                     std::uint32_t(p.index0), std::uint32_t(p.index1)});
    }
    return all;
  }

  /// The least distance, or +infinity without contacts.
  double deepest() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Point& p : points) least = std::min(least, p.distance);
    return least;
  }
};

}  // namespace octoblisk::testing
