// A ray in single precision, clipped to the vicinity of a tree.
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "base/rounding.h"
#include "octoblisk/raycast.h"
#include "tree/tree.h"

namespace octoblisk::detail {

/// The part of a ray near the tree: the points origin + reach · direction, 0 <= reach <= length, relative to
/// the tree's origin. The largest component of the direction is ±1.
struct LocalRay {
  std::array<float, 3> origin;
  std::array<float, 3> direction;
  /// The rounding error of any point of the ray or a triangle in the frame of a box or of the ray. Boxes are
  /// grown by it.
  float slack;
  float length;

  // reach = scale · (t − start)
  double scale;
  double start;

  /// At least the reach of a hit at t.
  float reachOf(double t) const { return static_cast<float>(std::min(scale * (t - start), 1e30)) + slack; }
};

/// None if the ray misses the sphere around the tree. `rounding`: the error of the ray's own points.
inline std::optional<LocalRay> clipped(const Tree& tree, const Ray& ray, double rounding = 0.0) {
  const double largest = ray.direction.cwiseAbs().maxCoeff();
  if (!ray.origin.allFinite() || !ray.direction.allFinite() || !(ray.t_max >= 0.0)) return std::nullopt;
  if (!(largest >= Ray::kMinDirection && largest <= TriangleMesh::kMaxCoordinate)) return std::nullopt;
  const Vec3 origin = ray.origin - tree.origin();
  const double distance = origin.cwiseAbs().maxCoeff();
  if (!(ray.origin.cwiseAbs().maxCoeff() <= TriangleMesh::kMaxCoordinate + rounding)) return std::nullopt;

  const double slack =
      2.0 * (kSingleRounding * tree.radius() + kDoubleRounding * distance) + rounding + 0x1p-120;
  const double radius = tree.radius() + slack;
  const double nearest = -origin.dot(ray.direction) / ray.direction.squaredNorm();  // to the middle
  if (!((origin + nearest * ray.direction).squaredNorm() <= radius * radius)) return std::nullopt;
  const double unit = 1.0 / largest;
  const double in_sphere = radius * unit;  // at least half the chord
  const double start = std::max(0.0, nearest - in_sphere);

  LocalRay local;
  for (int i = 0; i < 3; ++i) {
    local.origin[static_cast<std::size_t>(i)] = static_cast<float>(origin[i] + start * ray.direction[i]);
    local.direction[static_cast<std::size_t>(i)] = static_cast<float>(ray.direction[i] * unit);
  }
  local.slack = static_cast<float>(std::min(slack, 1e30));
  local.scale = largest;
  local.start = start;
  local.length = local.reachOf(std::min(nearest + in_sphere, ray.t_max));
  if (!(local.length >= 0.0f)) return std::nullopt;
  return local;
}

}  // namespace octoblisk::detail
