#include "models/blade_anatomy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/welded_surface.h"
#include "octoblisk/closest_point.h"

namespace octoblisk::demos {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;
constexpr int kEdgeSteps = 20;

double angleOf(const Vec3& point) { return std::atan2(point.y(), point.x()); }

/// The mean offset of a contour from its chord, towards greater angles, in chords. The contour is unrolled at
/// its mean radius.
double camberOf(const BladeContour& contour) {
  const Vec3& leading = contour.forward.front().position;
  const Vec3& trailing = contour.forward.back().position;
  const double radius = 0.5 * (radiusOf(leading) + radiusOf(trailing));
  const auto across = [&](const Vec3& point) {
    return radius * std::remainder(angleOf(point) - angleOf(leading), kWholeTurn);
  };
  const Eigen::Vector2d chord(trailing.z() - leading.z(), across(trailing));
  double camber = 0.0;
  for (const auto* half : {&contour.forward, &contour.backward}) {
    double length = 0.0, moment = 0.0;
    for (std::size_t k = 1; k < half->size(); ++k) {
      const Vec3& from = (*half)[k - 1].position;
      const Vec3& to = (*half)[k].position;
      const Vec3 middle = 0.5 * (from + to);
      const double offset =
          (chord.x() * across(middle) - chord.y() * (middle.z() - leading.z())) / chord.squaredNorm();
      length += (to - from).norm();
      moment += (to - from).norm() * offset;
    }
    camber += 0.5 * moment / length;
  }
  return camber;
}

BladeAnatomy anatomyOf(const BladeContours& contours) {
  BladeAnatomy blade;
  int cambers = 0;
  for (int step = 0; step <= kEdgeSteps; ++step) {
    const double height = static_cast<double>(step) / kEdgeSteps;
    const BladeContour contour = contours.at(height);
    blade.leading.push_back(contour.forward.front().position);
    blade.trailing.push_back(contour.forward.back().position);
    const bool is_middle = height > 0.29 && height < 0.71;
    if (!is_middle) continue;
    blade.camber += camberOf(contour);
    ++cambers;
  }
  blade.camber /= cambers;
  const double angle = angleOf(blade.leading.back());
  constexpr double kRounding = 1e-6;  // of the file's coordinates: angle 0 must not become a full turn
  blade.angle = angle < -kRounding ? angle + kWholeTurn : std::max(0.0, angle);
  return blade;
}

double distanceToLine(const std::vector<ContourPoint>& line, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < line.size(); ++k) {
    const Vec3& from = line[k - 1].position;
    const Vec3& to = line[k].position;
    least = std::min(least, distance(Triangle{from, to, to}, point));
  }
  return least;
}

double gapBetween(const std::vector<ContourPoint>& a, const std::vector<ContourPoint>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const ContourPoint& point : a) least = std::min(least, distanceToLine(b, point.position));
  for (const ContourPoint& point : b) least = std::min(least, distanceToLine(a, point.position));
  return least;
}

}  // namespace

BliskAnatomy findAnatomy(const TriangleMesh& blisk, const BladesFound& found) {
  BliskAnatomy anatomy;
  anatomy.sides = findBladeSides(blisk, found);
  std::vector<BladeContour> at_mid_height;
  for (int number = 1; number <= found.count; ++number) {
    const BladeContours contours(blisk, anatomy.sides, number);
    anatomy.blades.push_back(anatomyOf(contours));
    at_mid_height.push_back(contours.at(0.5));
  }
  for (std::size_t t = 0; t < blisk.triangleCount(); ++t) {
    const int number = anatomy.sides.blade_of_triangle[t];
    if (number == 0) continue;
    BladeAnatomy& blade = anatomy.blades[number - 1];
    const BladePart part = anatomy.sides.part_of_triangle[t];
    double& area = part == BladePart::forward    ? blade.forward_area
                   : part == BladePart::backward ? blade.backward_area
                                                 : blade.tip_area;
    area += 0.5 * scaledNormal(blisk.triangle(t)).norm();
    ++blade.triangles;
  }
  double camber = 0.0;
  for (int k = 0; k < found.count; ++k) {
    BladeAnatomy& blade = anatomy.blades[k];
    const BladeContour& next = at_mid_height[(k + 1) % found.count];
    blade.channel_width = gapBetween(at_mid_height[k].forward, next.backward);
    camber += blade.camber / found.count;
  }
  constexpr double kMinCamber = 0.003;
  if (std::abs(camber) >= kMinCamber) {
    anatomy.convex_side = camber > 0.0 ? BladeSide::forward : BladeSide::backward;
  }
  return anatomy;
}

}  // namespace octoblisk::demos
