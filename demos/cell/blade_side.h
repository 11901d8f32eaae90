// The two sides of a blade.
#pragma once

#include <cstdint>
#include <string>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// "forward" where a triangle of a blade, outward oriented, faces towards greater angles about Z, else
/// "backward"; empty for blade 0, hub or shroud.
inline std::string sideOf(const TriangleMesh& blisk, std::uint32_t triangle, int blade) {
  if (blade == 0) return {};
  const Triangle corners = blisk.triangle(triangle);
  const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  const Vec3 e_theta(-middle.y(), middle.x(), 0.0);
  return scaledNormal(corners).dot(e_theta) > 0.0 ? "forward" : "backward";
}

}  // namespace octoblisk::demos
