// A grinding belt as a Bullet soft body, tensioned on two wheels and driven by them.
#pragma once

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "models/belt_grinder.h"

namespace octoblisk::gallery {

/// Lengths in mm, times in s. The material values of the belt are assumed.
struct SoftBeltOptions {
  demos::BeltParameters sizes;  ///< width, thickness and wheels are used
  int stations = 240;           ///< along the loop, >= 32
  int nodes_across = 5;         ///< >= 3
  double strain = 0.02;         ///< of the belt on its wheels, relative to its rest length, > 0
  double speed = 300.0;         ///< along the loop, mm/s; clockwise seen from +z
  double mass = 0.05;           ///< kg
  int iterations = 30;          ///< of the solver, per step
};

/// The belt's nodes lie in the middle of its thickness, and its margin is half the thickness, so it collides
/// with all bodies of the world. `step` holds the belt on the wheels: a node inside a wheel is moved to its
/// surface and carried along. Bullet's own soft-body contacts cannot do this: they push a node out as fast as
/// it came in. The belt has no weight. Frames are as in belt_grinder.h: the contact wheel's centre is the
/// tool's origin, z the wheels' axis, and the drive wheel is on +x.
class SoftBelt {
 public:
  /// Adds the belt to the world, which must outlive it, and sets the world's distance field to millimetres.
  /// Throws std::invalid_argument for sizes that do not make a belt.
  SoftBelt(btSoftRigidDynamicsWorld& world, const SoftBeltOptions& options, const Pose& tool_in_world);
  ~SoftBelt();
  SoftBelt(const SoftBelt&) = delete;
  SoftBelt& operator=(const SoftBelt&) = delete;

  /// Steps the world, moves the wheels to the pose and turns them on.
  void step(const Pose& tool_in_world, double time_step);

  const Pose& toolInWorld() const { return tool_in_world_; }
  const btSoftBody& body() const { return *belt_; }
  Vec3 node(int station, int across) const;
  int stations() const { return options_.stations; }
  int nodesAcross() const { return options_.nodes_across; }

  /// The present strain of the loop: the mean over its links along the belt, and the least mean of the links
  /// from one station to the next.
  struct Strain {
    double mean, least;
  };
  Strain strain() const;

  /// Nodes that touched the object in the last step.
  std::vector<Vec3> contactsWith(const btCollisionObject& object) const;

  /// mm/s: the mean of all nodes along the belt.
  double meanSpeed() const;

  /// The look of the belt: a closed band of its thickness, in the world's frame.
  TriangleMesh mesh() const;

  /// The wheels, with a hub and holes that show their turning; in the world's frame.
  std::vector<TriangleMesh> wheelMeshes() const;

 private:
  struct Wheel {
    Vec3 centre;  ///< in the tool's frame
    double radius;
  };

  void makeBelt();
  void holdOn(const Wheel& wheel, const Pose& tool_before, double time_step);
  Pose poseOf(const Wheel& wheel) const;
  double rollingRadius(const Wheel& wheel) const { return wheel.radius + 0.5 * options_.sizes.thickness; }
  int index(int station, int across) const {
    return (station + options_.stations) % options_.stations * options_.nodes_across + across;
  }

  btSoftRigidDynamicsWorld& world_;
  SoftBeltOptions options_;
  Pose tool_in_world_;
  double travelled_ = 0.0;     ///< by the belt, mm
  std::vector<Wheel> wheels_;  ///< contact wheel, drive wheel
  std::unique_ptr<btSoftBody> belt_;
};

}  // namespace octoblisk::gallery
