// How much of a blade's side a path grinds.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "grinding/grinding_run.h"
#include "models/side_grid.h"

namespace octoblisk::demos {

/// How near the grinding part has to come to a point for its distance to be told, mm.
inline constexpr double kCoverageReach = 0.5;

/// Between poses the part is asked for at places no farther apart than this, mm: the way of the contact.
inline constexpr double kCoverageStep = 0.5;

/// What the grinding part does to a point of the blade's side.
struct GroundPoint {
  /// How deep the point is in the part, at most, mm; below 0, how near the part comes; minus infinity where
  /// that is farther than kCoverageReach.
  double depth = -std::numeric_limits<double>::infinity();
  std::size_t pose = 0;  ///< of the path: there, or nearest to there

  bool isGround() const { return depth >= 0.0; }
  bool isNear() const { return depth >= -kCoverageReach; }
};

/// The grid is in the frame whose Z is the blisk's axis.
struct Coverage {
  int blade = 0;
  SideGrid grid;
  std::string side;                 ///< "convex", "concave", or where that is not known "forward", "backward"
  Pose mesh_in_blisk;               ///< from the mesh's frame to the grid's
  double max_depth = 0.0;           ///< that the part may be pressed in, mm
  std::vector<GroundPoint> points;  ///< of the middles of the grid's cells

  /// Of the side's area.
  double groundShare() const;
  /// The rows, from the first to the last, half or more of which the part comes near; none where there are
  /// none.
  std::optional<std::pair<std::size_t, std::size_t>> reachedRows() const;
  /// The same of columns, within these rows.
  std::optional<std::pair<std::size_t, std::size_t>> reachedColumns() const;
  /// What is left standing between passes, mm: the most of the points that are not ground, but have ground
  /// ones above and below. Infinite where the part comes to none nearer than kCoverageReach.
  double scallopHeight() const;
};

/// Every pose and move of the path counts, whatever its verdict. `threads` as in parallelFor's threadCount;
/// the answer does not depend on their number.
std::vector<GroundPoint> groundPoints(const SideGrid& grid, const ClusteredOctree& part,
                                      std::span<const Pose> part_in_blisk, int threads = 0);

struct CoverageQuestion {
  const ClusteredOctree& blisk;  ///< faces outward
  std::span<const int> blade_of_triangle;
  int blade_count;
  Pose mesh_in_blisk;                    ///< from the mesh's frame to that with the blisk's axis Z
  std::optional<BladeSide> convex_side;  ///< none: not known
  int blade;                             ///< that is ground
  const ClusteredOctree& part;           ///< that grinds
  double max_depth;                      ///< that it may be pressed in, mm
  std::vector<Pose> path;                ///< of the part, in the mesh's frame
};

/// Of the side that the part touches at the most poses. None where it touches neither. Throws
/// std::invalid_argument where there is no such blade, or its side has no contours.
std::optional<Coverage> coverageOf(const CoverageQuestion& question, int threads = 0);

/// The same of a run; none where no blade is ground.
std::optional<Coverage> coverageOf(const GrindingRun& run, int threads = 0);

/// "Ground: 62 % of the convex side of blade 1".
std::string groundInWords(const Coverage& coverage);

/// "not reached: root below 0.43 of the height; left between passes: scallops up to 0.02 mm"; may be empty.
std::string leftInWords(const Coverage& coverage);

/// Both in one line; of none that nothing of the blade is ground.
std::string inWords(const std::optional<Coverage>& coverage, int blade);

}  // namespace octoblisk::demos
