// Shared by the tests of rays and convex sweeps: scenes, segments past them, and the plugin's shape without
// its fast path.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <compare>
#include <ostream>
#include <string>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk::testing {

/// The plugin's shape behind a callback that it does not know. It then reports every triangle in the bounds
/// of the segment.
ATTRIBUTE_ALIGNED16(struct)
Generic final : btConcaveShape {
  BT_DECLARE_ALIGNED_ALLOCATOR();
  explicit Generic(const ClusteredOctreeShape& wrapped) : shape(wrapped) {
    m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
  }
  void processAllTriangles(btTriangleCallback * callback, const btVector3& low, const btVector3& high)
      const override {
    struct Forward final : btTriangleCallback {
      btTriangleCallback* to;
      int* visited;
      void processTriangle(btVector3* triangle, int part, int index) override {
        ++*visited;
        to->processTriangle(triangle, part, index);
      }
    } forward;
    forward.to = callback;
    forward.visited = &visited;
    shape.processAllTriangles(&forward, low, high);
  }
  void getAabb(const btTransform& t, btVector3& low, btVector3& high) const override {
    shape.getAabb(t, low, high);
  }
  void setLocalScaling(const btVector3&) override {}
  const btVector3& getLocalScaling() const override { return shape.getLocalScaling(); }
  void calculateLocalInertia(btScalar, btVector3&) const override {}
  const char* getName() const override { return "generic"; }

  const ClusteredOctreeShape& shape;
  mutable int visited = 0;
};

struct Hit {
  btScalar fraction;
  int part, triangle;
  btScalar x, y, z;  // of the normal
  auto operator<=>(const Hit&) const = default;
};

template <typename Result>
Hit hitOf(const Result& result) {
  const btVector3& normal = result.m_hitNormalLocal;
  return {result.m_hitFraction,
          result.m_localShapeInfo->m_shapePart,
          result.m_localShapeInfo->m_triangleIndex,
          normal.x(),
          normal.y(),
          normal.z()};
}

/// The hits that a Bullet callback receives: all of them, or the closest.
struct Hits {
  bool all;
  std::vector<Hit> found = {};

  /// The new limit of the fraction of later hits.
  template <typename Result>
  btScalar gather(const Result& result, btScalar& closest) {
    if (!all) {
      closest = result.m_hitFraction;
      found.clear();
    }
    found.push_back(hitOf(result));
    return closest;
  }
  std::vector<Hit> sorted() {
    std::ranges::sort(found);
    return found;
  }
};

struct Scene {
  const char* name;
  SharedMesh mesh;
  Vec3 scaling;
  double miss;  // greatest distance of rays from a vertex

  ClusteredOctreeShape shape() const {
    ClusteredOctreeShape made(treeOver(mesh));
    made.setMargin(0);
    made.setLocalScaling(toBullet(scaling));
    return made;
  }
};

inline void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

inline std::vector<Scene> scenes() {
  const Vec3 one = Vec3::Ones();
  return {{"torus", torus(2, 0.7, 48, 24), one, 1.0},
          {"wave", waveSheet(4, 0.5, 40), one, 0.6},
          {"blades", fan(11, 24), one, 0.2},
          {"stretched torus", torus(2, 0.7, 48, 24), {1.5, 0.5, 1}, 0.8},
          {"mirrored blades", fan(11, 24), {-1, 1.2, 0.8}, 0.15}};
}

struct Way {
  Vec3 from, to;
};

inline Way randomWay(std::mt19937_64& random, const Scene& scene) {
  const auto& vertices = scene.mesh->vertices();
  const Vec3 vertex = vertices[random() % vertices.size()].cwiseProduct(scene.scaling);
  const Vec3 target = vertex + randomPoint(random, scene.miss);
  const Vec3 from = randomPoint(random, 5.0);
  Vec3 to = from + uniform(random, 0.4, 1.6) * (target - from);
  if (random() % 4 == 0) to[int(random() % 3)] = from[int(random() % 3)];
  return {from, to};
}

/// A shape as the only object of a world's query, at a pose.
struct Object {
  Object(const btCollisionShape& shape, const btTransform& pose) {
    object.setCollisionShape(const_cast<btCollisionShape*>(&shape));
    object.setWorldTransform(pose);
  }
  void ray(const Way& way, btCollisionWorld::RayResultCallback& callback) const {
    const btTransform& pose = object.getWorldTransform();
    btTransform from(btQuaternion::getIdentity(), pose * toBullet(way.from));
    btTransform to(btQuaternion::getIdentity(), pose * toBullet(way.to));
    btCollisionWorld::rayTestSingle(from, to, const_cast<btCollisionObject*>(&object),
                                    object.getCollisionShape(), pose, callback);
  }
  void sweep(const btConvexShape& convex, const Pose& from, const Pose& to,
             btCollisionWorld::ConvexResultCallback& callback) const {
    const btTransform& pose = object.getWorldTransform();
    btCollisionWorld::objectQuerySingle(&convex, pose * toBullet(from), pose * toBullet(to),
                                        const_cast<btCollisionObject*>(&object), object.getCollisionShape(),
                                        pose, callback, 0);
  }
  btCollisionObject object;
};

/// For INSTANTIATE_TEST_SUITE_P.
inline std::string nameOf(const ::testing::TestParamInfo<Scene>& scene) {
  std::string name = scene.param.name;
  std::ranges::replace(name, ' ', '_');
  return name;
}

}  // namespace octoblisk::testing
