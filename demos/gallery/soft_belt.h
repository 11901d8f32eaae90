// A grinding belt as a soft body of Bullet's, tensioned on two wheels and driven by them.
#pragma once

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "models/belt_grinder.h"

namespace octoblisk::gallery {

/// Lengths in mm, times in s. All numbers of the belt's stuff are assumed.
struct SoftBeltOptions {
  demos::BeltParameters sizes;  ///< width, thickness, wheels; the rest is not used
  int stations = 240;           ///< round the loop, >= 32
  int nodes_across = 5;         ///< >= 3
  double strain = 0.02;         ///< by which the belt is longer on its wheels than at rest, > 0
  double speed = 300.0;         ///< along the loop, mm/s; clockwise seen from +z
  double mass = 0.05;           ///< kg
  int iterations = 30;          ///< of the solver, a step
};

/// The belt's nodes lie in the middle of its thickness, its margin is half of that: so it meets all that is
/// in the world. The wheels it is held on by `step`: a node within a wheel is put back on it and goes with
/// it. To Bullet's own contacts of soft bodies a wheel is no hold: they throw a node out as fast as it came
/// in. The belt has no weight. Frames as in belt_grinder.h: the contact wheel's centre is the tool's origin,
/// z the wheels' axis, and the drive wheel is on +x.
class SoftBelt {
 public:
  /// Puts the belt into the world, which must outlive it, and whose distance field this sets to what
  /// millimetres need. Throws std::invalid_argument for sizes that make no belt.
  SoftBelt(btSoftRigidDynamicsWorld& world, const SoftBeltOptions& options, const Pose& tool_in_world);
  ~SoftBelt();
  SoftBelt(const SoftBelt&) = delete;
  SoftBelt& operator=(const SoftBelt&) = delete;

  /// Steps the world, and with it moves the wheels there and turns them on.
  void step(const Pose& tool_in_world, double time_step);

  const Pose& toolInWorld() const { return tool_in_world_; }
  const btSoftBody& body() const { return *belt_; }
  Vec3 node(int station, int across) const;
  int stations() const { return options_.stations; }
  int nodesAcross() const { return options_.nodes_across; }

  /// How much longer than at rest the loop is now: the mean over its links along the belt, and the least mean
  /// of the links from one station to the next.
  struct Strain {
    double mean, least;
  };
  Strain strain() const;

  /// Nodes that touched the object in the last step.
  std::vector<Vec3> contactsWith(const btCollisionObject& object) const;

  /// mm/s, of all nodes along the belt.
  double meanSpeed() const;

  /// What the belt looks like: a closed band of its thickness, in the world's frame.
  TriangleMesh mesh() const;

  /// The wheels with a hub and holes, so that one sees them turn; in the world's frame.
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
