// A Bullet world in which the blisk may turn on its spindle and the belt presses on it: the forces of
// grinding.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "grinding/belt_loop.h"
#include "grinding/grinding_cell.h"

namespace octoblisk::demos {

/// All assumed but the depth, which is measured.
struct SpindleOptions {
  double stiffness = 1000.0;  ///< N/mm, > 0: of wheel and belt, by how deep the belt is in the blisk
  double friction = 0.3;      ///< coefficient between belt and blisk, >= 0
  double hold = 100.0;        ///< N·m that the spindle's brake holds, >= 0; 0: it turns freely
  double density = 4.43e-6;   ///< kg/mm³, of the blisk: a titanium alloy's
};

/// What the belt does to the blisk at a pose. Vectors are in the frame of the blisk's mesh.
struct SpindleLoad {
  double normal_force = 0.0;    ///< N: the sum over the points of contact
  double friction_force = 0.0;  ///< N, the same
  Vec3 force = Vec3::Zero();    ///< N, of all together, on the blisk
  double torque = 0.0;          ///< N·m on the blisk about its axis
  double acceleration = 0.0;    ///< rad/s² of the blisk, beyond what the brake holds
};

/// The blisk in the frame of its spindle, to be shared by cells: the same tree where that is the mesh's
/// frame.
std::shared_ptr<const ClusteredOctree> onSpindle(std::shared_ptr<const ClusteredOctree> blisk,
                                                 const Pose& mesh_in_blisk);

/// One a thread.
class SpindleCell {
 public:
  /// `blisk`: as onSpindle gives it; `mesh_in_blisk`: from its mesh's frame to that whose Z is the spindle.
  /// The belt runs at `belt_speed` (m/s, of either sign). Throws std::invalid_argument where the blisk
  /// encloses no volume.
  SpindleCell(std::shared_ptr<const ClusteredOctree> blisk, const Pose& mesh_in_blisk, const ToolPart& belt,
              double belt_speed, const SpindleOptions& options);
  ~SpindleCell();
  SpindleCell(const SpindleCell&) = delete;
  SpindleCell& operator=(const SpindleCell&) = delete;

  /// The load by the belt at a pose where it is `depth` (mm) deep in the blisk, which is at rest: the
  /// solver's impulses in a step of 0.1 ms over its length. Its normal force is stiffness · depth, shared by
  /// the points of contact, less what the blisk gives way in the step; friction, up to the coefficient times
  /// it, goes along the belt's surface velocity; a belt that stands has none. Nothing where nothing touches.
  /// The answer does not depend on the poses before.
  std::optional<SpindleLoad> loadAt(const Pose& tool_in_mesh, double depth);

 private:
  class World;
  std::unique_ptr<World> world_;
};

}  // namespace octoblisk::demos
