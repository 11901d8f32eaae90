#include "grinding/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

#include "base/parallel.h"
#include "models/belt_grinder.h"
#include "models/blade_sides.h"
#include "models/blisk_axis.h"
#include "models/shared_tree.h"
#include "models/triangle_tree.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/containment.h"
#include "octoblisk/motion.h"
#include "octoblisk/path_query.h"
#include "octoblisk/triangles_in_box.h"
#include "query/farthest_vertex.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

/// The size of the grid's cells, mm: a lightly pressed pass grinds a line about a millimetre wide.
constexpr double kCellHeight = 0.5, kCellWidth = 1.0;
constexpr int kMaxLines = 300;

int linesOver(double length, double step) {
  return std::clamp(static_cast<int>(std::lround(length / step)), 1, kMaxLines);
}

double lengthOf(const std::vector<Vec3>& line) {
  double length = 0.0;
  for (std::size_t k = 1; k < line.size(); ++k) length += (line[k] - line[k - 1]).norm();
  return length;
}

/// A place of the part, and the pose nearest to it.
struct Place {
  Pose part_in_blisk;
  std::size_t pose;
};

std::vector<Place> placesAlong(std::span<const Pose> poses) {
  std::vector<Place> places;
  for (std::size_t p = 0; p < poses.size(); ++p) {
    if (p > 0) {
      const Motion motion(poses[p - 1], poses[p]);
      const double length = motion.advance().norm() + motion.angle() * kNearGrinding;
      const int steps = static_cast<int>(std::ceil(length / kCoverageStep));
      for (int k = 1; k < steps; ++k) {
        const double fraction = static_cast<double>(k) / steps;
        places.push_back({motion.at(fraction), fraction < 0.5 ? p - 1 : p});
      }
    }
    places.push_back({poses[p], p});
  }
  return places;
}

/// Measures one place after another; each thread has its own.
class GroundSearch {
 public:
  GroundSearch(const SideGrid& grid, const ClusteredOctree& cells, const octoblisk::Surface& part,
               const SupportPlanes& planes)
      : grid_(grid),
        cells_(cells),
        part_(part),
        planes_(planes),
        asked_at_(grid.size(), 0),
        last_(grid.size()),
        found_(grid.size()) {
    constexpr int kBoxDepth = 3;
    boxes_ = part.tree().boxes(kBoxDepth);
  }

  void ask(const Place& place) {
    ++time_;
    const Pose blisk_in_part = place.part_in_blisk.inverse();
    for (const Obb& box : boxes_) {
      const Vec3 reach = box.half_extents.array() + kCoverageReach;
      forEachTriangleIn(cells_, place.part_in_blisk * box, kCoverageReach, [&](std::uint32_t triangle) {
        const std::size_t cell = triangle / 2;
        if (asked_at_[cell] == time_) return false;
        const Vec3 point = blisk_in_part * grid_.middleOf(cell).position;
        if (((box.axes.transpose() * (point - box.center)).cwiseAbs().array() > reach.array()).any())
          return false;
        asked_at_[cell] = time_;
        if (!isShallower(cell, point)) measure(cell, point, place.pose);
        return false;
      });
    }
  }

  /// Keeps the deeper of two; of equally deep ones, that of the earlier pose.
  static void keepDeeper(GroundPoint& best, const GroundPoint& other) {
    if (other.depth > best.depth || (other.depth == best.depth && other.pose < best.pose)) best = other;
  }

  const std::vector<GroundPoint>& found() const { return found_; }

 private:
  /// A point in the part's frame, a depth that it does not exceed there, and a plane that it was above.
  struct Bound {
    Vec3 point = Vec3::Zero();
    double depth = std::numeric_limits<double>::infinity();
    std::optional<std::size_t> plane;
  };

  /// Whether a cell is proved to be shallower here than before: its depth grows by no more than its way in
  /// the part's frame, and it is at least as far from the part as it is above the plane.
  bool isShallower(std::size_t cell, const Vec3& point) const {
    constexpr double kRounding = 1e-9;  // mm
    const Bound& last = last_[cell];
    const double least = std::max(found_[cell].depth, -kCoverageReach) - kRounding;
    return last.depth + (point - last.point).norm() < least ||
           (last.plane && -planes_.heightAbove(*last.plane, point) < least);
  }

  void measure(std::size_t cell, const Vec3& point, std::size_t pose) {
    const ClusteredOctree& tree = part_.tree();
    const auto near = closestPoint(tree, point, kCoverageReach);
    if (near && near->distance < found_[cell].depth) {
      last_[cell] = {point, near->distance, std::nullopt};
      return;
    }
    const ClosestPoint nearest = near ? *near : closestPoint(tree, point).value();
    const bool is_inside = locate(part_, point, nearest) == PointLocation::inside;
    const double depth = is_inside ? nearest.distance : -nearest.distance;
    last_[cell] = {};
    if (part_.isWhole()) {  // where a surface bounds no solid, the depth may jump
      last_[cell] = {point, depth, std::nullopt};
      if (depth < 0.0) last_[cell].plane = planes_.facing(point - nearest.point);
    }
    if (near || is_inside) keepDeeper(found_[cell], {depth, pose});
  }

  const SideGrid& grid_;
  const ClusteredOctree& cells_;
  const octoblisk::Surface& part_;
  const SupportPlanes& planes_;
  std::vector<Obb> boxes_;
  std::vector<std::size_t> asked_at_;
  std::vector<Bound> last_;  // per cell: at its last measurement
  std::vector<GroundPoint> found_;
  std::size_t time_ = 0;
};

/// True if the part comes near at least half of the cells of a row or column, by area.
bool isMostlyNear(const Coverage& coverage, std::span<const std::size_t> cells) {
  double near = 0.0, all = 0.0;
  for (const std::size_t cell : cells) {
    all += coverage.grid.areaOf(cell);
    if (coverage.points[cell].isNear()) near += coverage.grid.areaOf(cell);
  }
  return near >= 0.5 * all;
}

/// The first and the last of the lines that are mostly reached.
std::optional<std::pair<std::size_t, std::size_t>> reachedLines(
    const Coverage& coverage, std::size_t count,
    const std::function<std::vector<std::size_t>(std::size_t)>& cellsOf) {
  std::optional<std::pair<std::size_t, std::size_t>> lines;
  for (std::size_t line = 0; line < count; ++line) {
    if (!isMostlyNear(coverage, cellsOf(line))) continue;
    if (!lines) lines = {line, line};
    lines->second = line;
  }
  return lines;
}

/// The region of a side's grid that a point near it faces.
BladeRegion regionAt(const SideGrid& side, const ClosestPoint& nearest) {
  const std::size_t row = nearest.triangle / 2 / side.columns(), lower = row * (side.columns() + 1);
  const auto isNear = [&](std::size_t corner) {
    return (side.corners()[corner] - nearest.point).norm() <= kEdgeReach;
  };
  if (isNear(lower)) return BladeRegion::leading_edge;
  return isNear(lower + side.columns()) ? BladeRegion::trailing_edge : side.region();
}

/// The region nearest to the tool's origin at most of the poses at which the part touches the blade.
std::optional<BladeRegion> regionFaced(const GrindingJob& job, std::span<const Pose> path,
                                       const BladeSides& sides, const BladeContours& contours) {
  const TriangleMesh& mesh = job.blisk->mesh();
  std::vector<TriangleMesh::Indices> triangles;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (sides.blade_of_triangle[t] == job.rules.ground_blade) triangles.push_back(mesh.triangles()[t]);
  }
  const auto blade = treeOfTriangles(mesh, std::move(triangles));
  PathQuery touching(*blade, *job.parts[job.rules.grinding_part].tree);
  const std::array grids = {gridOver(contours, BladeRegion::forward),
                            gridOver(contours, BladeRegion::backward)};
  const std::array trees = {treeOf(grids[0].mesh()), treeOf(grids[1].mesh())};
  std::map<BladeRegion, std::size_t> poses;
  for (const Pose& pose : path) {
    if (!touching.collide(pose)) continue;
    const Vec3 origin = (job.mesh_in_blisk * pose).translation;
    const std::array nearest = {closestPoint(*trees[0], origin).value(),
                                closestPoint(*trees[1], origin).value()};
    const std::size_t side = nearest[1].distance < nearest[0].distance ? 1 : 0;
    ++poses[regionAt(grids[side], nearest[side])];
  }
  const auto most = std::ranges::max_element(poses, {}, [](const auto& entry) { return entry.second; });
  if (most == poses.end()) return std::nullopt;
  return most->first;
}

std::string nameOf(BladeRegion region, std::optional<BladeSide> convex) {
  if (region == BladeRegion::leading_edge) return "leading";
  if (region == BladeRegion::trailing_edge) return "trailing";
  const bool is_forward = region == BladeRegion::forward;
  if (!convex) return is_forward ? "forward" : "backward";
  return is_forward == (*convex == BladeSide::forward) ? "convex" : "concave";
}

}  // namespace

SideGrid gridOver(const BladeContours& contours, BladeRegion region) {
  const SideGrid coarse(contours, region, 8, 8);
  std::vector<Vec3> up, along;
  for (std::size_t k = 0; k < 8; ++k) {
    up.push_back(coarse.middleOf(8 * k + 4).position);
    along.push_back(coarse.middleOf(8 * 4 + k).position);
  }
  constexpr double kWhole = 8.0 / 7.0;  // of the distance between the first centre and the last
  return SideGrid(contours, region, linesOver(kWhole * lengthOf(up), kCellHeight),
                  linesOver(kWhole * lengthOf(along), kCellWidth));
}

std::string nameOf(CellState state) {
  constexpr std::array kNames = {"ground", "too deep", "left standing", "not reached"};
  return kNames[static_cast<std::size_t>(state)];
}

CellState Coverage::stateOf(std::size_t cell) const {
  const GroundPoint& point = points[cell];
  if (!point.isNear()) return CellState::not_reached;
  if (!point.isTouched()) return CellState::left_standing;
  return point.depth <= max_depth ? CellState::ground : CellState::too_deep;
}

double Coverage::share(CellState state) const {
  double in_state = 0.0, all = 0.0;
  for (std::size_t cell = 0; cell < points.size(); ++cell) {
    all += grid.areaOf(cell);
    if (stateOf(cell) == state) in_state += grid.areaOf(cell);
  }
  return in_state / all;
}

std::array<double, kCellStates.size()> Coverage::percents() const {
  std::array<double, kCellStates.size()> percents;
  double sum = 0.0, tenths = 0.0;  // of the states so far; the sum is rounded, so no error adds up
  for (std::size_t k = 0; k < percents.size(); ++k) {
    sum += share(kCellStates[k]);
    percents[k] = (std::round(1000.0 * sum) - tenths) / 10.0;
    tenths = std::round(1000.0 * sum);
  }
  return percents;
}

std::optional<std::pair<std::size_t, std::size_t>> Coverage::reachedRows() const {
  return reachedLines(*this, grid.rows(), [&](std::size_t row) {
    std::vector<std::size_t> cells;
    for (std::size_t column = 0; column < grid.columns(); ++column)
      cells.push_back(row * grid.columns() + column);
    return cells;
  });
}

std::optional<std::pair<std::size_t, std::size_t>> Coverage::reachedColumns() const {
  const auto rows = reachedRows();
  if (!rows) return std::nullopt;
  return reachedLines(*this, grid.columns(), [&](std::size_t column) {
    std::vector<std::size_t> cells;
    for (std::size_t row = rows->first; row <= rows->second; ++row)
      cells.push_back(row * grid.columns() + column);
    return cells;
  });
}

double Coverage::scallopHeight() const {
  double most = 0.0;
  for (std::size_t column = 0; column < grid.columns(); ++column) {
    const auto isTouched = [&](std::size_t row) { return points[row * grid.columns() + column].isTouched(); };
    std::size_t first = 0, end = grid.rows();
    while (first < end && !isTouched(first)) ++first;
    while (end > first && !isTouched(end - 1)) --end;
    for (std::size_t row = first; row < end; ++row) {
      most = std::max(most, -points[row * grid.columns() + column].depth);
    }
  }
  return most;
}

std::vector<GroundPoint> groundPoints(const SideGrid& grid, const ClusteredOctree& part,
                                      std::span<const Pose> part_in_blisk, int threads) {
  const std::vector<Place> places = placesAlong(part_in_blisk);
  const ClusteredOctree cells = ClusteredOctree::build(std::make_shared<const TriangleMesh>(grid.mesh()));
  const octoblisk::Surface surface(part, threads);
  const SupportPlanes planes(part, threads);
  std::vector<GroundSearch> searches(static_cast<std::size_t>(threadCount(threads)),
                                     GroundSearch(grid, cells, surface, planes));
  constexpr std::size_t kAtOnce = 16;
  parallelFor((places.size() + kAtOnce - 1) / kAtOnce, threads, [&](std::size_t block, std::size_t worker) {
    const std::size_t end = std::min(places.size(), (block + 1) * kAtOnce);
    for (std::size_t i = block * kAtOnce; i < end; ++i) searches[worker].ask(places[i]);
  });
  std::vector<GroundPoint> points(grid.size());
  for (const GroundSearch& search : searches) {
    for (std::size_t cell = 0; cell < points.size(); ++cell) {
      GroundSearch::keepDeeper(points[cell], search.found()[cell]);
    }
  }
  return points;
}

std::optional<Coverage> coverageOf(const GrindingJob& job, std::span<const Pose> path,
                                   std::optional<BladeSide> convex) {
  const int blade = job.rules.ground_blade;
  const std::size_t part = job.rules.grinding_part;
  if (blade == 0 || part == kNoPart) return std::nullopt;
  const TriangleMesh about_axis = moved(job.blisk->mesh(), job.mesh_in_blisk);
  const BladeSides sides = findBladeSides(about_axis, job.blades);
  const BladeContours contours(about_axis, sides, blade);
  const std::optional<BladeRegion> region = regionFaced(job, path, sides, contours);
  if (!region) return std::nullopt;
  Coverage coverage{.blade = blade,
                    .grid = gridOver(contours, *region),
                    .side = nameOf(*region, convex),
                    .mesh_in_blisk = job.mesh_in_blisk,
                    .max_depth = job.rules.maxDepth(part),
                    .points = {}};
  std::vector<Pose> poses;
  for (const Pose& pose : path) poses.push_back(job.mesh_in_blisk * pose);
  coverage.points = groundPoints(coverage.grid, *job.parts[part].tree, poses, job.threads);
  return coverage;
}

std::string regionText(const Coverage& coverage) {
  const char* const kind = isEdge(coverage.grid.region()) ? " edge" : " side";
  return coverage.side + kind + " of blade " + std::to_string(coverage.blade);
}

std::string groundText(const Coverage& coverage) {
  const auto percents = coverage.percents();
  std::ostringstream text;
  text << "Ground: " << percents[0] << " % of the " << regionText(coverage);
  for (std::size_t k = 1; k < percents.size(); ++k)
    text << (k == 1 ? "; " : ", ") << nameOf(kCellStates[k]) << ": " << percents[k] << " %";
  return text.str();
}

std::string leftText(const Coverage& coverage) {
  const auto rows = coverage.reachedRows(), columns = coverage.reachedColumns();
  std::ostringstream text;
  text.precision(2);
  const auto add = [&](const char* what, std::size_t line, std::size_t count, const char* of) {
    text << (text.str().empty() ? "Not reached: " : ", ") << what << ' '
         << static_cast<double>(line) / static_cast<double>(count) << of;
  };
  const std::size_t row_count = coverage.grid.rows(), column_count = coverage.grid.columns();
  if (rows && rows->first > 0) add("root below", rows->first, row_count, " of the height");
  if (rows && rows->second + 1 < row_count) add("tip above", rows->second + 1, row_count, " of the height");
  const bool is_edge = isEdge(coverage.grid.region());
  const char* const of = is_edge ? " of the width" : " of the chord";
  if (columns && columns->first > 0)
    add(is_edge ? "backward side before" : "leading edge before", columns->first, column_count, of);
  if (columns && columns->second + 1 < column_count) {
    add(is_edge ? "forward side beyond" : "trailing edge beyond", columns->second + 1, column_count, of);
  }
  const double scallop = coverage.scallopHeight();
  if (scallop == 0.0) return text.str();
  text << (text.str().empty() ? "Left between passes: " : "; left between passes: ");
  if (std::isinf(scallop)) {
    text << "more than " << kCoverageReach << " mm";
  } else {
    text << "scallops up to " << scallop << " mm";
  }
  return text.str();
}

std::string summaryText(const Coverage& coverage) {
  const std::string left = leftText(coverage);
  return groundText(coverage) + '\n' + left + (left.empty() ? "" : "\n");
}

namespace {

constexpr std::size_t kCells = 32;  // along each edge of a side of the cube

}  // namespace

SupportPlanes::SupportPlanes(const ClusteredOctree& tree, int threads) : planes_(6 * kCells * kCells) {
  parallelFor(planes_.size(), threads, [&](std::size_t plane, std::size_t) {
    const std::size_t side = plane / (kCells * kCells), row = plane / kCells % kCells,
                      column = plane % kCells;
    const auto middle = [](std::size_t cell) {
      return (2.0 * static_cast<double>(cell) + 1.0) / kCells - 1.0;
    };
    const auto axis = static_cast<Eigen::Index>(side / 2);
    Vec3 direction;
    direction[axis] = side % 2 == 0 ? 1.0 : -1.0;
    direction[(axis + 1) % 3] = middle(row);
    direction[(axis + 2) % 3] = middle(column);
    const Vec3 normal = direction.normalized();
    planes_[plane] = {normal, normal.dot(farthestVertex(tree, normal))};
  });
}

std::size_t SupportPlanes::facing(const Vec3& direction) const {
  Eigen::Index axis;
  const double largest = direction.cwiseAbs().maxCoeff(&axis);
  const auto cellOf = [&](Eigen::Index other) {
    const double at = 0.5 * (direction[other % 3] / largest + 1.0) * kCells;
    return std::min(static_cast<std::size_t>(at), kCells - 1);
  };
  const std::size_t side = 2 * static_cast<std::size_t>(axis) + (direction[axis] < 0.0);
  return (side * kCells + cellOf(axis + 1)) * kCells + cellOf(axis + 2);
}

}  // namespace octoblisk::demos
