// A convex primitive of Bullet and a small mesh, for contenders that differ only in the shape of the mesh.
#pragma once

#include <btBulletCollisionCommon.h>

#include <memory>

#include "bullet_world.h"
#include "contender.h"

namespace octoblisk::bench {

/// Its margin is Bullet's default.
inline std::unique_ptr<btConvexShape> primitiveShape(Primitive primitive) {
  const auto [core, core_margin] = roundedCore(primitive);
  const auto margin = static_cast<btScalar>(core_margin);
  const btVector3 half = toBullet(core->bounds().max), outer = half + btVector3(margin, margin, margin);
  switch (primitive) {
    case Primitive::sphere:
      return std::make_unique<btSphereShape>(margin);
    case Primitive::box:
      return std::make_unique<btBoxShape>(outer);
    case Primitive::capsule:
      return std::make_unique<btCapsuleShapeZ>(margin, 2 * half.z());
    case Primitive::cylinder:
      return std::make_unique<btCylinderShapeZ>(outer);
    case Primitive::hull:
      break;
  }
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& corner : core->vertices()) hull->addPoint(toBullet(corner), false);
  hull->recalcLocalAabb();
  return hull;
}

/// `Mesh` is constructed from a scene. It has the mesh's shape as blisk(), and registerAt(dispatcher) for its
/// own algorithms. The mesh's margin is 0.
template <typename Mesh>
class PrimitiveOnMesh final : public WorldPrimitiveQuery {
 public:
  explicit PrimitiveOnMesh(const Scene& scene) : world_(scene) {}
  double nearest(const Pose& primitive_in_mesh) override { return world_.nearest(primitive_in_mesh, 0.0); }

 private:
  class Shapes {
   public:
    explicit Shapes(const Scene& scene) : mesh_(scene), primitive_(primitiveShape(scene.primitive)) {
      mesh_.blisk()->setMargin(0);
    }
    void registerAt(btCollisionDispatcher* dispatcher) { mesh_.registerAt(dispatcher); }
    btCollisionShape* blisk() { return mesh_.blisk(); }
    btCollisionShape* belt() { return primitive_.get(); }

   private:
    Mesh mesh_;
    std::unique_ptr<btConvexShape> primitive_;
  };

  InBulletWorld<Shapes> world_;
};

}  // namespace octoblisk::bench
