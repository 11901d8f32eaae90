// The soft belt, driven by its wheels and pressed against the convex side of a blade.
#pragma once

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>

#include <memory>

#include "gallery/gallery_scene.h"
#include "gallery/soft_belt.h"
#include "models/blade_finder.h"
#include "octoblisk/surface.h"
#include "octoblisk_bullet/clustered_octree_shape.h"

namespace octoblisk::gallery {

/// Lengths in mm, times in s. The belt's lower strand lies along the chord, between its wheels; the tool
/// approaches from the side.
struct BeltOnBladeOptions {
  std::size_t blisk_triangles = 20'000;
  SoftBeltOptions belt = {.sizes = {.contact_wheel_radius = 8.0, .drive_wheel_radius = 12.0}};
  double height = 0.8;        ///< of the strand on the blade: root 0 to tip 1
  double clearance = 4.0;     ///< from the surface to the strand at the start
  double press = 4.0;         ///< distance that the tool moves beyond first touch
  double press_begin = 0.05;  ///< s
  double press_end = 0.3;     ///< s
  BuildOptions tree = {};     ///< of the blisk
};

class BeltOnBlade final : public GalleryScene {
 public:
  static constexpr double kTimeStep = 1.0 / 960.0;  ///< s; the belt moves by a third of a millimetre per step

  explicit BeltOnBlade(const BeltOnBladeOptions& options = {});
  ~BeltOnBlade() override;

  void step() override;
  demos::Picture picture() const override;
  std::vector<Number> numbers() const override;

  double time() const { return time_; }
  const SoftBelt& belt() const { return *belt_; }
  const ClusteredOctree& blisk() const { return shape_.tree(); }

  /// Nodes for which Bullet had a contact with the blisk in the last step.
  std::vector<Vec3> contacts() const { return belt_->contactsWith(blisk_body_); }

  /// Nodes where the belt's surface is at most `gap` (mm) from the blisk's.
  std::vector<Vec3> touching(double gap = 0.1) const;

  /// The depth of the deepest node in the blisk, mm; 0 if no node is inside.
  double deepestNode() const;

 private:
  Pose toolAt(double time) const;

  BeltOnBladeOptions options_;
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btSoftRigidDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  ClusteredOctreeShape shape_;
  Surface surface_;
  btRigidBody blisk_body_{0, nullptr, &shape_};
  demos::BladesFound blades_;
  Pose touching_;  ///< of the tool in the blisk, with the strand at the surface
  std::unique_ptr<SoftBelt> belt_;
  double time_ = 0.0;
};

}  // namespace octoblisk::gallery
