// A Bullet world with an arm of joint motors that carries a belt grinder beside a fixed blisk.
//
// Lengths in mm, masses in kg, times in seconds; so forces are in kg mm/s² = mN, torques in kg mm²/s² = µN m.
// Gravity is 9810 mm/s² down.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "grinding/grinding_cell.h"
#include "paper/robot/six_axis_arm.h"

namespace octoblisk::demos {

/// The motor of each joint: it turns at the commanded rate times `feedforward`, plus the position error times
/// `position_gain`, within the limit of its torque. Assumed.
struct ServoOptions {
  double position_gain = 40.0;  ///< 1/s
  double feedforward = 0.9;     ///< fraction of the commanded rate
  /// Greatest torques, N m.
  Joints torque = (Joints() << 4000.0, 4000.0, 2500.0, 500.0, 400.0, 200.0).finished();
};

struct RobotCellSetup {
  SixAxisArm arm;
  ServoOptions servo;
  std::shared_ptr<const ClusteredOctree> blisk;
  std::vector<ToolPart> tool;  ///< the belt grinder's parts, in the belt's frame
  double tool_mass = 12.0;     ///< kg, spread evenly over the parts' volumes; assumed
  Pose blisk_in_base;
  Pose tool_in_flange;
};

/// The believed state of the arm and its tool: the encoders' values, and the error of the tool.
struct StateEstimate {
  Joints joints;
  Pose tool_error;  ///< in the tool's frame: the believed tool, relative to the tool that the joints give
};

/// A contact or near miss of a moving body with the blisk.
struct CellContact {
  std::size_t body = 0;        ///< 0 to 5: a link; from 6: a part of the tool
  std::uint32_t triangle = 0;  ///< of the blisk
  double distance = 0.0;       ///< mm; <= 0: touching
  Vec3 point = Vec3::Zero();   ///< on the blisk, in the base
};

/// The arm is a btMultiBody: six hinged convex links and, fixed to the flange, one link per part of the tool
/// with our shape. The blisk is a static body with our shape, and the broadphase is ours. Contacts are
/// detected but have no effect on the arm, because the force of grinding is not modelled.
class RobotCell {
 public:
  static constexpr std::size_t kLinks = 6;

  /// Throws std::invalid_argument for a missing blisk, a tool without parts, or a negative position gain,
  /// feedforward, torque or mass.
  explicit RobotCell(RobotCellSetup setup);
  ~RobotCell();
  RobotCell(const RobotCell&) = delete;
  RobotCell& operator=(const RobotCell&) = delete;

  const RobotCellSetup& setup() const { return setup_; }

  /// Moves the arm to the joints, at rest.
  void place(const Joints& joints);

  /// Lets the motors follow a command that runs evenly from one position to the next, for `seconds`, in
  /// `steps` steps of the world. The servos see the joints with the encoders' error.
  void drive(const Joints& from, const Joints& to, double seconds, int steps, const Joints& encoder_error);

  Joints joints() const;

  /// Frame 1 to 6 (index 0 to 5) in the base, as Bullet has it.
  Pose linkFrame(std::size_t link) const;
  Pose toolInBlisk() const;  ///< as Bullet has it

  /// The believed pose of the tool.
  Pose toolInBlisk(const StateEstimate& estimate) const;

  /// Bullet's contacts of all moving bodies with the blisk, with all bodies at their believed poses: pairs
  /// from the broadphase, then the closest-points query for each, up to the distance `reach` (mm, >= 0). The
  /// arm itself does not move. The result is valid until the next call.
  std::span<const CellContact> detect(const StateEstimate& estimate, double reach);

 private:
  class World;
  RobotCellSetup setup_;
  std::vector<CellContact> contacts_;
  std::unique_ptr<World> world_;
};

}  // namespace octoblisk::demos
