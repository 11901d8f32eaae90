// The runs of a pass on which the tool is free.
#pragma once

#include <vector>

#include "grinding/judge.h"
#include "plan/pass_lines.h"
#include "toolpath/wheel_seat.h"

namespace octoblisk::demos {

/// Places the tool on the cells of a grid in one posture.
class Placer {
 public:
  /// The grid, the seat and the posture must outlive it. Lengths in mm.
  Placer(const SurfaceGrid& grid, const WheelSeat& seat, const ToolPosture& posture, double wheel_radius,
         double depth)
      : grid_(grid), seat_(seat), posture_(posture), wheel_radius_(wheel_radius), depth_(depth) {}

  /// The wheel touches the blade near the cell, and is pressed in by the depth.
  Pose at(std::size_t cell) const {
    const SurfacePoint& point = grid_.points[cell];
    return seat_.seated(poseAt(point, posture_, wheel_radius_), point.normal, depth_);
  }
  const SurfacePoint& point(std::size_t cell) const { return grid_.points[cell]; }

 private:
  const SurfaceGrid& grid_;
  const WheelSeat& seat_;
  const ToolPosture& posture_;
  double wheel_radius_, depth_;
};

/// Successive contacts; the tool is free at all of them, touches the blade, and is free on the motions
/// between them.
struct FreeRun {
  std::vector<std::size_t> cells;
  std::vector<Pose> poses;
};

/// The free runs of passes, in their order. A chord between two contacts leaves the line by at most
/// `chord_error` (mm). Contacts are added between a free and a blocked one, and on motions that are blocked,
/// until they are neighbours on the line.
std::vector<FreeRun> freeRuns(Judge& judge, const Placer& placer, const std::vector<PassLine>& passes,
                              double chord_error);

}  // namespace octoblisk::demos
