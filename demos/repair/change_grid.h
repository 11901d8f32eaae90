// How a pose of the grinder may be changed: by tilt, slide and retraction, each on a grid of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// Degrees and mm, against the pose of the path.
struct Change {
  double tilt = 0.0;     ///< about the wheels' axis: z through the tool's origin
  double slide = 0.0;    ///< along the wheels' axis, so that another part of the belt's width grinds
  double retract = 0.0;  ///< off the surface for up to kLift, farther along the arm (the tool's x)

  bool isNone() const { return tilt == 0.0 && slide == 0.0 && retract == 0.0; }
};

/// mm of a retraction that go along the normal of the surface.
inline constexpr double kLift = 1.0;

/// The pose with a change; `off_surface` is a unit direction away from the ground surface. The tilt changes
/// none of the directions that slide and retraction go.
Pose changedPose(const Pose& tool_in_blisk, const Vec3& off_surface, const Change& change);

/// Degrees and mm.
struct ChangeLimits {
  double tilt = 30.0;             ///< at most, either way
  double tilt_grid = 2.0;         ///< spacing
  double tilt_per_pose = 4.0;     ///< change from a pose to the next
  double slide = 6.0;             ///< at most, either way
  double slide_grid = 2.0;        ///< spacing
  double slide_per_pose = 2.0;    ///< change from a pose to the next
  double retract = 40.0;          ///< at most
  double retract_grid = 0.05;     ///< spacing of the first ten steps; wider beyond
  double retract_per_pose = 2.0;  ///< change from a pose to the next
};

/// Values of the grid count as equal within this.
inline constexpr double kGridRounding = 1e-9;

/// All combinations; "nodes", numbered with the retraction running first, then the slide, then the tilt.
class ChangeGrid {
 public:
  /// Nodes at most.
  static constexpr std::size_t kMostNodes = 0xffff;

  /// Throws std::invalid_argument in one line naming a limit that is out of its range: lengths and angles not
  /// finite or below 0, a spacing not above 0 or above the change from pose to pose, too many nodes.
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

  /// What a change costs at a pose, and what a change of the change costs from a pose to the next: a degree
  /// as much as a millimetre of slide, a millimetre of retraction, which costs the contact, twenty times it.
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
