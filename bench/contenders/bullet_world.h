// What the contenders that ask Bullet share: a world, meshes in its layout, contacts by contactPairTest.
#pragma once

#include <btBulletCollisionCommon.h>

#include <memory>
#include <vector>

#include "scene.h"

namespace octoblisk::bench {

inline btVector3 toBullet(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

inline btTransform toBullet(const Pose& pose) {
  const Eigen::Matrix<btScalar, 3, 3> r = pose.rotation.cast<btScalar>();
  const btMatrix3x3 rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2));
  return btTransform(rotation, toBullet(pose.translation));
}

/// Vertices and indices as Bullet reads them.
class BulletMesh {
 public:
  explicit BulletMesh(const TriangleMesh& mesh) {
    for (const Vec3& vertex : mesh.vertices()) {
      for (const double x : vertex) vertices_.push_back(static_cast<btScalar>(x));
    }
    for (const auto& corners : mesh.triangles())
      indices_.insert(indices_.end(), corners.begin(), corners.end());
    constexpr int kIndexStride = 3 * sizeof(int);
    constexpr int kVertexStride = 3 * sizeof(btScalar);
    view_ = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(mesh.triangleCount()), indices_.data(), kIndexStride,
        static_cast<int>(mesh.vertices().size()), vertices_.data(), kVertexStride);
  }

  btTriangleIndexVertexArray* view() const { return view_.get(); }

 private:
  std::vector<btScalar> vertices_;
  std::vector<int> indices_;
  std::unique_ptr<btTriangleIndexVertexArray> view_;
};

/// Two objects, one of which is moved.
class BulletWorld {
 public:
  /// Shapes are to outlive the world.
  BulletWorld(btCollisionShape* blisk, btCollisionShape* belt) {
    blisk_.setCollisionShape(blisk);
    belt_.setCollisionShape(belt);
  }

  btCollisionDispatcher& dispatcher() { return dispatcher_; }

  /// The contact points of depth 0 or more.
  std::size_t contacts(const Pose& belt_in_blisk) {
    belt_.setWorldTransform(toBullet(belt_in_blisk));
    Touching touching;
    world_.contactPairTest(&blisk_, &belt_, touching);
    return touching.count;
  }

 private:
  struct Touching : btCollisionWorld::ContactResultCallback {
    std::size_t count = 0;
    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
      count += point.getDistance() <= 0;
      return 0;
    }
  };

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
  btCollisionObject blisk_, belt_;
};

}  // namespace octoblisk::bench
