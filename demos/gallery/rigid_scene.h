// The common base of rigid-body scenes: a world, colours, a camera.
#pragma once

#include <memory>
#include <vector>

#include "gallery/bullet_world.h"
#include "gallery/gallery_scene.h"
#include "shapes/bodies.h"

namespace octoblisk::gallery {

/// Derived classes fill the world. Only bodies with a ClusteredOctreeShape, or with a shape made by
/// `shapeOf`, are drawn.
class RigidScene : public GalleryScene {
 public:
  void step() override { world_.step(1, time_step_); }
  demos::Picture picture() const override;

 protected:
  RigidScene(double time_step, BuildOptions tree) : time_step_(time_step), tree_(std::move(tree)) {}

  /// Our shape, kept as long as the scene. The margin suits bodies of about a metre: with it they rest more
  /// calmly.
  ClusteredOctreeShape& shapeOf(const shapes::SharedMesh& mesh, double margin = 0.01);

  /// Draws a body of the world.
  void show(const btRigidBody& body, const demos::Color& color) { colors_.emplace_back(&body, color); }

  /// Adds a body to the world, and draws it.
  btRigidBody& add(btCollisionShape& shape, double mass, const btTransform& pose, const demos::Color& color);

  /// Sets the box that the camera shows completely.
  void look(const Aabb& box, const Vec3& direction) { seen_ = box, direction_ = direction; }

 private:
  std::vector<std::unique_ptr<ClusteredOctreeShape>> shapes_;
  std::vector<std::pair<const btRigidBody*, demos::Color>> colors_;
  double time_step_;
  BuildOptions tree_;  ///< for all shapes
  Aabb seen_;
  Vec3 direction_ = -Vec3::UnitZ();

 protected:
  BulletWorld world_;
};

}  // namespace octoblisk::gallery
