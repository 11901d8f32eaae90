#include "models/ring.h"

#include <algorithm>
#include <cmath>

namespace octoblisk::demos {
namespace {

constexpr double kSurfaceCoarseness = 1.2;
constexpr double kFaceCoarseness = 2.5;

}  // namespace

int MeridianLeg::cells(double spacing) const {
  const double length = std::hypot(z_end - z_start, radius_end - radius_start);
  constexpr double kMaxCells = 1e8;  // more than any mesh has, but convertible to an integer
  return static_cast<int>(std::lround(std::clamp(length / (coarseness * spacing), 1.0, kMaxCells)));
}

CylindricalPoint MeridianLeg::at(double fraction, double angle) const {
  const double z = std::lerp(z_start, z_end, fraction);
  return {z, along ? along->radiusAt(z) + lift : std::lerp(radius_start, radius_end, fraction), angle};
}

std::vector<MeridianLeg> hubBand(const RadiusProfile& hub, double bore_radius, double z_leading,
                                 double z_trailing) {
  const double front = hub.zMin();
  const double back = hub.zMax();
  const double front_radius = hub.radiusAt(front);
  const double back_radius = hub.radiusAt(back);
  return {{z_leading, front, hub.radiusAt(z_leading), front_radius, &hub, 0.0, kSurfaceCoarseness},
          {front, front, front_radius, bore_radius, nullptr, 0.0, kFaceCoarseness},
          {front, back, bore_radius, bore_radius, nullptr, 0.0, kFaceCoarseness},
          {back, back, bore_radius, back_radius, nullptr, 0.0, kFaceCoarseness},
          {back, z_trailing, back_radius, hub.radiusAt(z_trailing), &hub, 0.0, kSurfaceCoarseness}};
}

std::vector<MeridianLeg> shroudBand(const RadiusProfile& inner, const BliskOptions& options, double z_leading,
                                    double z_trailing) {
  const double front = z_leading - options.shroud_overhang;
  const double back = z_trailing + options.shroud_overhang;
  const double front_radius = inner.radiusAt(front);
  const double back_radius = inner.radiusAt(back);
  const double thickness = options.shroud_thickness;
  return {
      {z_leading, front, inner.radiusAt(z_leading), front_radius, &inner, 0.0, kSurfaceCoarseness},
      {front, front, front_radius, front_radius + thickness, nullptr, 0.0, kFaceCoarseness},
      {front, back, front_radius + thickness, back_radius + thickness, &inner, thickness, kSurfaceCoarseness},
      {back, back, back_radius + thickness, back_radius, nullptr, 0.0, kFaceCoarseness},
      {back, z_trailing, back_radius, inner.radiusAt(z_trailing), &inner, 0.0, kSurfaceCoarseness}};
}

RadiusProfile tipProfile(const BladeGrid& blade) {
  std::vector<RadiusProfile::Point> points;
  for (int station = 0; station <= blade.chordCells(); ++station) {
    const CylindricalPoint& forward = blade.at(BladeSide::forward, blade.spanCells(), station);
    const CylindricalPoint& backward = blade.at(BladeSide::backward, blade.spanCells(), station);
    points.push_back({0.5 * (forward.z + backward.z), 0.5 * (forward.radius + backward.radius)});
  }
  return RadiusProfile(std::move(points));
}

}  // namespace octoblisk::demos
