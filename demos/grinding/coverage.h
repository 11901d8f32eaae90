// How much of a side or an edge of a blade a path grinds.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "grinding/grinding_run.h"
#include "models/side_grid.h"
#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

/// Distances of the grinding part beyond this are not measured, mm.
inline constexpr double kCoverageReach = 0.5;

/// The greatest distance between two sampled places of the part between poses, mm, along the contact's path.
inline constexpr double kCoverageStep = 0.5;

/// What the grinding part does to a cell: it is within its depth limit there at its deepest, or exceeds it;
/// it comes within kCoverageReach but does not touch; or it stays farther away.
enum class CellState { ground, too_deep, left_standing, not_reached };
inline constexpr std::array kCellStates = {CellState::ground, CellState::too_deep, CellState::left_standing,
                                           CellState::not_reached};

/// "ground", "too deep", "left standing", "not reached".
std::string nameOf(CellState state);

/// What the grinding part does to a point of the blade.
struct GroundPoint {
  /// The point's greatest depth in the part, mm. If negative, the least distance to the part; minus infinity
  /// beyond kCoverageReach.
  double depth = -std::numeric_limits<double>::infinity();
  std::size_t pose = 0;  ///< the path's pose at which that happens, or the one nearest to it

  bool isTouched() const { return depth >= 0.0; }
  bool isNear() const { return depth >= -kCoverageReach; }
};

/// The grid is in the frame whose Z is the blisk's axis.
struct Coverage {
  int blade = 0;
  SideGrid grid;
  /// "convex" or "concave"; "forward" or "backward" if that is unknown; "leading" or "trailing" for an edge
  std::string side;
  Pose mesh_in_blisk;               ///< from the mesh's frame to the grid's
  double max_depth = 0.0;           ///< the depth that the part may be pressed in, mm
  std::vector<GroundPoint> points;  ///< at the centres of the grid's cells

  CellState stateOf(std::size_t cell) const;
  /// The share of the grid's area in this state.
  double share(CellState state) const;
  /// The shares in the order of kCellStates, in percent, rounded to one decimal so that they add up to 100.
  std::array<double, kCellStates.size()> percents() const;
  /// The first and the last row that the part comes near to over at least half of their length, if any.
  std::optional<std::pair<std::size_t, std::size_t>> reachedRows() const;
  /// The same for the columns, within these rows.
  std::optional<std::pair<std::size_t, std::size_t>> reachedColumns() const;
  /// The greatest height left between passes, mm: over the points that are not touched but have touched
  /// points above and below. Infinite if the part stays farther than kCoverageReach from one of them.
  double scallopHeight() const;
};

/// The cells of a coverage over a side or an edge.
SideGrid gridOver(const BladeContours& contours, BladeRegion region);

/// Every pose and every motion of the path counts, whatever its verdict. `threads` as in parallelFor;
/// the result does not depend on it.
std::vector<GroundPoint> groundPoints(const SideGrid& grid, const ClusteredOctree& part,
                                      std::span<const Pose> part_in_blisk, int threads = 0);

/// The coverage of the side or edge of the ground blade that the path is made for: the one nearest to the
/// tool's origin, the centre of the contact wheel, at most of the poses at which the grinding part touches
/// the blade. `convex` is the convex side, empty if unknown. Empty if the job grinds no blade, or the part
/// does not touch it. Throws std::invalid_argument if the blade does not exist or its sides have no contours.
std::optional<Coverage> coverageOf(const GrindingJob& job, std::span<const Pose> path,
                                   std::optional<BladeSide> convex);

/// "convex side of blade 1", "leading edge of blade 1".
std::string regionText(const Coverage& coverage);

/// "Ground: 7.8 % of the convex side of blade 1; too deep: 2.2 %, left standing: 45 %, not reached: 45 %".
std::string groundText(const Coverage& coverage);

/// "Not reached: root below 0.43 of the height; left between passes: scallops up to 0.02 mm"; may be empty.
std::string leftText(const Coverage& coverage);

/// Both, each on a line of its own.
std::string summaryText(const Coverage& coverage);

/// Planes that touch a mesh from outside, with normals spread over all directions, at most 0.045 rad from
/// any. Immutable.
class SupportPlanes {
 public:
  explicit SupportPlanes(const ClusteredOctree& tree, int threads = 0);

  /// The plane whose normal is among the nearest to a direction, which must not be zero.
  std::size_t facing(const Vec3& direction) const;

  /// The height of a point above a plane. If positive, the point is outside the mesh, at least this far away.
  double heightAbove(std::size_t plane, const Vec3& point) const {
    return planes_[plane].normal.dot(point) - planes_[plane].offset;
  }

 private:
  struct Plane {
    Vec3 normal;
    double offset;
  };
  std::vector<Plane> planes_;  // a grid on each side of a cube: +x, -x, +y, …
};

}  // namespace octoblisk::demos
