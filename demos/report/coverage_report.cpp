#include "report/coverage_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <span>
#include <sstream>
#include <vector>

#include "io/new_file.h"
#include "io/number_text.h"
#include "render/picture.h"
#include "render/side_map.h"

namespace octoblisk::demos {
namespace {

/// A step of the colour scale: cells in a state, and of these the ones up to a depth, mm. A negative depth is
/// material left standing.
struct DepthStep {
  CellState state;
  double most;
  Color color;
  std::string text;
};

/// The greater the depth, the later the step.
std::vector<DepthStep> depthStepsFor(double limit) {
  using enum CellState;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  constexpr double kFar = 0.1, kNear = 0.02;  // mm: a scallop, a facet's distance from the smooth blade
  const auto upTo = [](double depth) { return "up to " + shortText(depth) + " mm"; };
  return {{not_reached, kAny, palette::kSteel, nameOf(not_reached)},
          {left_standing, -kFar, palette::kSand, nameOf(left_standing) + ", " + upTo(kCoverageReach)},
          {left_standing, -kNear, palette::kYellow, upTo(kFar)},
          {left_standing, kAny, {0.98f, 0.96f, 0.75f}, upTo(kNear)},
          {ground, 0.25 * limit, {0.75f, 0.87f, 0.66f}, nameOf(ground) + ", " + upTo(0.25 * limit) + " deep"},
          {ground, 0.5 * limit, {0.45f, 0.76f, 0.55f}, upTo(0.5 * limit)},
          {ground, kAny, {0.10f, 0.52f, 0.40f}, upTo(limit)},
          {too_deep, kAny, palette::kVermilion, nameOf(too_deep)}};
}

std::size_t stepOf(const Coverage& coverage, std::size_t cell, std::span<const DepthStep> steps) {
  const auto step = std::ranges::find_if(steps, [&](const DepthStep& each) {
    return each.state == coverage.stateOf(cell) && coverage.points[cell].depth <= each.most;
  });
  return static_cast<std::size_t>(step - steps.begin());
}

std::string hexOf(const Color& color) {
  std::ostringstream text;
  text << '#' << std::hex << std::setfill('0');
  for (const float value : {color.r, color.g, color.b}) text << std::setw(2) << std::lround(255.0f * value);
  return text.str();
}

}  // namespace

void writeCoverage(const Coverage& coverage, const std::filesystem::path& file) {
  std::ostringstream stream;
  stream.precision(9);
  stream << "height,chord,x_mm,y_mm,z_mm,area_mm2,state,depth_mm,pose\n";
  const Pose blisk_in_mesh = coverage.mesh_in_blisk.inverse();
  for (std::size_t cell = 0; cell < coverage.points.size(); ++cell) {
    const GroundPoint& point = coverage.points[cell];
    const Vec3 place = blisk_in_mesh * coverage.grid.middleOf(cell).position;
    stream << coverage.grid.heightOf(cell) << ',' << coverage.grid.chordOf(cell) << ',' << place.x() << ','
           << place.y() << ',' << place.z() << ',' << coverage.grid.areaOf(cell) << ','
           << nameOf(coverage.stateOf(cell)) << ',';
    if (point.isNear()) stream << point.depth << ',' << point.pose;
    if (!point.isNear()) stream << ',';
    stream << '\n';
  }
  writeFile(file, stream.str());
}

Image coveragePicture(const Coverage& coverage, int width, int height) {
  const SideGrid& grid = coverage.grid;
  const auto distanceBetween = [&](std::size_t a, std::size_t b) {
    return (grid.middleOf(a).position - grid.middleOf(b).position).norm();
  };
  const std::vector<DepthStep> steps = depthStepsFor(coverage.max_depth);
  std::vector<MapCell> cells;
  const std::size_t amid = grid.columns() / 2;
  double above = 0.0;  // height of the row's lower edge
  for (std::size_t row = 0; row < grid.rows(); ++row) {
    const std::size_t begin = row * grid.columns();
    const std::size_t other = row + 1 < grid.rows() ? begin + grid.columns() : begin - grid.columns();
    const double half_height = 0.5 * distanceBetween(begin + amid, other + amid);
    double length = 0.0;
    for (std::size_t k = 1; k < grid.columns(); ++k) length += distanceBetween(begin + k - 1, begin + k);
    const double half_width = 0.5 * length / static_cast<double>(grid.columns() - 1);
    for (std::size_t k = 0; k < grid.columns(); ++k) {
      cells.push_back({(2.0 * static_cast<double>(k) + 1.0) * half_width, above + half_height, half_width,
                       half_height, steps[stepOf(coverage, begin + k, steps)].color});
    }
    above += 2.0 * half_height;
  }
  Annotation annotation{.title = groundText(coverage), .length_unit = "mm"};
  std::ostringstream subtitle;
  const std::string left = leftText(coverage);
  if (!left.empty()) subtitle << left << "; ";
  subtitle << "horizontal: arc length from the "
           << (isEdge(grid.region()) ? "backward to the forward side" : "leading edge")
           << ", vertical: height above the root";
  annotation.subtitle = subtitle.str();
  for (const DepthStep& step : steps) annotation.legend.push_back({step.color, step.text});
  return sideMap(cells, annotation, width, height);
}

ReplaySide coverageOnBlade(const Coverage& coverage) {
  constexpr double kLift = 0.2;  // mm: clears a blade that is simplified for display
  const SideGrid& grid = coverage.grid;
  const Pose blisk_in_mesh = coverage.mesh_in_blisk.inverse();
  ReplaySide side{.name = "coverage", .columns = grid.columns()};
  for (std::size_t corner = 0; corner < grid.corners().size(); ++corner) {
    const std::size_t row = std::min(corner / (grid.columns() + 1), grid.rows() - 1);
    const std::size_t column = std::min(corner % (grid.columns() + 1), grid.columns() - 1);
    const Vec3& normal = grid.middleOf(row * grid.columns() + column).normal;
    side.corners.push_back(blisk_in_mesh * Vec3(grid.corners()[corner] + kLift * normal));
  }
  const std::vector<DepthStep> steps = depthStepsFor(coverage.max_depth);
  for (std::size_t cell = 0; cell < coverage.points.size(); ++cell) {
    side.color_of_cell.push_back(static_cast<std::uint8_t>(stepOf(coverage, cell, steps)));
  }
  for (const DepthStep& step : steps) side.colors.push_back({hexOf(step.color), step.text});
  side.region = regionText(coverage);
  constexpr std::array kTones = {Tone::intended, Tone::interference, Tone::near, Tone::clear};
  const auto percents = coverage.percents();
  for (std::size_t k = 0; k < percents.size(); ++k)
    side.shares.push_back({nameOf(kCellStates[k]), percents[k], kTones[k]});
  return side;
}

}  // namespace octoblisk::demos
