#include "report/coverage_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <vector>

#include "io/new_file.h"
#include "render/picture.h"
#include "render/side_map.h"

namespace octoblisk::demos {
namespace {

/// A step of the colour scale: depths up to this fraction of the limit.
struct DepthStep {
  double most;
  Color color;
  const char* text;
};
constexpr std::array kDepthSteps = {DepthStep{0.0, palette::kYellow, "left standing, by up to 0.5 mm"},
                                    DepthStep{0.25, {0.75f, 0.87f, 0.66f}, "ground, up to 1/4 of the limit"},
                                    DepthStep{0.5, {0.45f, 0.76f, 0.55f}, "1/2"},
                                    DepthStep{1.0, {0.10f, 0.52f, 0.40f}, "the limit"},
                                    DepthStep{1e300, palette::kVermilion, "deeper"}};
constexpr Color kNotReached = palette::kSteel;
constexpr std::size_t kColors = kDepthSteps.size() + 1;

/// 0: not reached; otherwise one more than the index of the step.
std::size_t colorIndexOf(const GroundPoint& point, double limit) {
  if (!point.isNear()) return 0;
  if (!point.isGround()) return 1;
  const auto reaches = [&](const DepthStep& step) { return point.depth <= step.most * limit; };
  const auto step = std::find_if(kDepthSteps.begin() + 1, kDepthSteps.end() - 1, reaches);
  return 1 + static_cast<std::size_t>(step - kDepthSteps.begin());
}

Color colorOf(std::size_t index) { return index == 0 ? kNotReached : kDepthSteps[index - 1].color; }
const char* nameOf(std::size_t index) { return index == 0 ? "not reached" : kDepthSteps[index - 1].text; }

std::string hexOf(const Color& color) {
  std::ostringstream text;
  text << '#' << std::hex << std::setfill('0');
  for (const float value : {color.r, color.g, color.b}) text << std::setw(2) << std::lround(255.0f * value);
  return text.str();
}

const char* stateOf(const GroundPoint& point, double limit) {
  if (!point.isNear()) return "not reached";
  if (!point.isGround()) return "left standing";
  return point.depth <= limit ? "ground" : "too deep";
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
           << stateOf(point, coverage.max_depth) << ',';
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
                       half_height, colorOf(colorIndexOf(coverage.points[begin + k], coverage.max_depth))});
    }
    above += 2.0 * half_height;
  }
  Annotation annotation{.title = groundText(coverage), .length_unit = "mm"};
  std::ostringstream subtitle;
  const std::string left = leftText(coverage);
  if (!left.empty()) subtitle << left << "; ";
  subtitle << "horizontal: arc length from the leading edge, vertical: height above the root";
  annotation.subtitle = subtitle.str();
  for (std::size_t index = 0; index < kColors; ++index) {
    annotation.legend.push_back({colorOf(index), nameOf(index)});
  }
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
  for (const GroundPoint& point : coverage.points) {
    side.color_of_cell.push_back(static_cast<std::uint8_t>(colorIndexOf(point, coverage.max_depth)));
  }
  for (std::size_t index = 0; index < kColors; ++index) {
    side.colors.push_back({hexOf(colorOf(index)), nameOf(index)});
  }
  return side;
}

}  // namespace octoblisk::demos
