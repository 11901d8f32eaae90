// The changes that can be made to a pose of the grinder: tilt, slide and retraction, each on its own grid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// In degrees and mm, relative to the pose of the path.
struct Change {
  double tilt = 0.0;     ///< about the wheels' axis: z through the tool's origin
  double slide = 0.0;    ///< along the wheels' axis, so that another part of the belt's width grinds
  double retract = 0.0;  ///< off the surface up to kLift, then along the arm (the tool's x)

  bool isNone() const { return tilt == 0.0 && slide == 0.0 && retract == 0.0; }
};

/// The length of a retraction along the normal of the surface, mm.
inline constexpr double kLift = 1.0;

/// The changed pose; `off_surface` is a unit direction away from the ground surface. The tilt does not change
/// the directions of slide and retraction.
Pose changedPose(const Pose& tool_in_blisk, const Vec3& off_surface, const Change& change);

/// In degrees and mm.
struct ChangeLimits {
  double tilt = 30.0;             ///< greatest, in either direction
  double tilt_grid = 2.0;         ///< spacing
  double tilt_per_pose = 4.0;     ///< greatest change from a pose to the next
  double slide = 6.0;             ///< greatest, in either direction
  double slide_grid = 2.0;        ///< spacing
  double slide_per_pose = 2.0;    ///< greatest change from a pose to the next
  double retract = 40.0;          ///< greatest
  double retract_grid = 0.05;     ///< spacing of the first ten steps; the steps beyond are wider
  double retract_per_pose = 2.0;  ///< greatest change from a pose to the next
};

/// Values of the grid count as equal within this distance.
inline constexpr double kGridRounding = 1e-9;

/// All combinations, called nodes; the retraction varies fastest in their numbering, then the slide, then the
/// tilt.
class ChangeGrid {
 public:
  /// The greatest number of nodes.
  static constexpr std::size_t kMaxNodes = 0xffff;

  /// Throws std::invalid_argument with a one-line message that names a limit out of range: a length or angle
  /// that is negative or not finite, a spacing not above 0 or above the change from pose to pose, too many
  /// nodes.
  explicit ChangeGrid(const ChangeLimits& limits);

  const std::vector<double>& tilts() const { return tilts_; }
  const std::vector<double>& slides() const { return slides_; }
  const std::vector<double>& retracts() const { return retracts_; }
  const ChangeLimits& limits() const { return limits_; }

  std::size_t size() const { return tilts_.size() * slides_.size() * retracts_.size(); }
  std::uint32_t node(std::size_t tilt, std::size_t slide, std::size_t retract) const {
    return static_cast<std::uint32_t>((tilt * slides_.size() + slide) * retracts_.size() + retract);
  }
  Change change(std::uint32_t node) const;
  std::uint32_t noChange() const { return no_change_; }

  /// The cost of a change at a pose, and of a difference between the changes of two neighbouring poses. A
  /// degree of tilt costs as much as a millimetre of slide; a millimetre of retraction costs twenty times
  /// that, because it loses the contact.
  double cost(const Change& change) const;
  double tiltStepCost(double degrees) const;
  double slideStepCost(double length) const;
  double retractStepCost(double length) const;

 private:
  ChangeLimits limits_;
  std::vector<double> tilts_, slides_, retracts_;  // ascending
  std::uint32_t no_change_ = 0;
};

}  // namespace octoblisk::demos
