// A Bullet world for the grinding forces: the blisk may turn on its spindle, and the belt presses on it.
#pragma once

#include <memory>
#include <optional>

#include "grinding/belt_loop.h"
#include "grinding/grinding_cell.h"

namespace octoblisk::demos {

/// Assumed values; the depth is measured instead.
struct SpindleOptions {
  double stiffness = 1000.0;  ///< N/mm, > 0: of wheel and belt, by the belt's depth in the blisk
  double friction = 0.3;      ///< coefficient between belt and blisk, >= 0
  double hold = 100.0;        ///< N·m that the spindle's brake holds, >= 0; 0: it turns freely
  double density = 4.43e-6;   ///< kg/mm³, of the blisk: that of a titanium alloy
};

/// The belt's load on the blisk at a pose. Vectors are in the frame of the blisk's mesh.
struct SpindleLoad {
  double normal_force = 0.0;    ///< N: the sum over the contact points
  double friction_force = 0.0;  ///< N: the sum over the contact points
  Vec3 force = Vec3::Zero();    ///< N: the resultant on the blisk
  double torque = 0.0;          ///< N·m on the blisk, about its axis
  double acceleration = 0.0;    ///< rad/s² of the blisk, beyond the torque that the brake holds
};

/// The blisk in the frame of its spindle, for several cells to share: the same tree if that is the mesh's
/// frame.
std::shared_ptr<const ClusteredOctree> onSpindle(std::shared_ptr<const ClusteredOctree> blisk,
                                                 const Pose& mesh_in_blisk);

/// One per thread.
class SpindleCell {
 public:
  /// `blisk` comes from onSpindle; `mesh_in_blisk` is from its mesh's frame to the frame whose Z is the
  /// spindle. The belt runs at `belt_speed` (m/s, of either sign). Throws std::invalid_argument if the blisk
  /// encloses no volume.
  SpindleCell(std::shared_ptr<const ClusteredOctree> blisk, const Pose& mesh_in_blisk, const ToolPart& belt,
              double belt_speed, const SpindleOptions& options);
  ~SpindleCell();
  SpindleCell(const SpindleCell&) = delete;
  SpindleCell& operator=(const SpindleCell&) = delete;

  /// The belt's load at a pose where it is `depth` (mm) deep in the blisk, which is at rest: the solver's
  /// impulses in a step of 0.1 ms, divided by the step. The normal force is stiffness · depth, shared by the
  /// contact points, minus the effect of the blisk's motion in the step. Friction, up to the coefficient
  /// times the normal force, acts along the belt's surface velocity; a belt at rest has none. Nothing if
  /// nothing touches. The answer does not depend on earlier poses.
  std::optional<SpindleLoad> loadAt(const Pose& tool_in_mesh, double depth);

 private:
  class World;
  std::unique_ptr<World> world_;
};

}  // namespace octoblisk::demos
