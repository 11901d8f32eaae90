#include "shapes/splines.h"

#include <cmath>
#include <numbers>

#include "shapes/dimensions.h"
#include "shapes/rims.h"

namespace octoblisk::shapes {
namespace {

constexpr const char* kSpline = "a spline";

using Section = std::vector<Eigen::Vector2d>;

/// Of the shaft, with all its faces moved outward: four corners a tooth.
Section sectionOf(const Spline& spline, double outward) {
  const double half_angle = std::numbers::pi / spline.teeth, half_width = 0.5 * spline.width + outward;
  const double root = (spline.root + outward - half_width * std::sin(half_angle)) / std::cos(half_angle);
  const double tip = spline.tip + outward;
  Section section;
  for (int tooth = 0; tooth < spline.teeth; ++tooth) {
    const Eigen::Rotation2Dd turn(2 * tooth * half_angle);
    for (const auto& [along, across] :
         {std::pair(root, -half_width), {tip, -half_width}, {tip, half_width}, {root, half_width}})
      section.push_back(turn * Eigen::Vector2d(along, across));
  }
  return section;
}

Rim rimOf(Welded& mesh, const Section& section, double z) {
  Rim rim;
  for (const Eigen::Vector2d& corner : section) rim.push_back(mesh.vertex({corner.x(), corner.y(), z}));
  return rim;
}

void check(const Spline& spline, double length) {
  if (spline.teeth < 3) refuse(kSpline, "number of teeth", spline.teeth);
  requirePositive(kSpline, "root", spline.root);
  requirePositive(kSpline, "tip", spline.tip);
  requirePositive(kSpline, "width", spline.width);
  requireNotNegative(kSpline, "clearance", spline.clearance);
  requirePositive(kSpline, "length", length);
  const double half_angle = std::numbers::pi / spline.teeth, half_width = 0.5 * spline.width;
  const double ground = (spline.root + spline.clearance) * std::sin(half_angle);  // in the hub
  if (half_width + spline.clearance >= ground) refuse(kSpline, "width", spline.width);
  if (sectionOf(spline, 0.0).front().x() >= spline.tip) refuse(kSpline, "tip", spline.tip);
}

}  // namespace

SharedMesh splineShaft(const Spline& spline, double length) {
  check(spline, length);
  Welded mesh;
  const Section section = sectionOf(spline, 0.0);
  const Rim low = rimOf(mesh, section, 0.0), high = rimOf(mesh, section, length);
  addDisk(mesh, high, length);
  addWall(mesh, low, high);
  addDisk(mesh, reversed(low), 0.0);
  return mesh.mesh();
}

SharedMesh splineHub(const Spline& spline, double length) {
  check(spline, length);
  Welded mesh;
  const Section bore = sectionOf(spline, spline.clearance);
  const double radius = 2.0 * bore[1].norm();
  Section outside;
  for (const Eigen::Vector2d& corner : bore) outside.push_back(radius * corner.normalized());
  const Rim low = rimOf(mesh, bore, 0.0), high = rimOf(mesh, bore, length),
            outer_low = rimOf(mesh, outside, 0.0), outer_high = rimOf(mesh, outside, length);
  addRing(mesh, high, outer_high);
  addWall(mesh, reversed(low), reversed(high));  // faces the axis
  addWall(mesh, outer_low, outer_high);
  addRing(mesh, reversed(low), reversed(outer_low));
  return mesh.mesh();
}

}  // namespace octoblisk::shapes
