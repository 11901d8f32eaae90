// The two sides of a blade.
#pragma once

#include <cstdint>
#include <string>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// "forward" where a triangle of a blade, outward oriented, faces towards greater angles about the blisk's
/// axis, else "backward"; empty for blade 0, hub or shroud. `mesh_in_blisk`: to the frame whose Z is the
/// axis.
inline std::string sideOf(const TriangleMesh& mesh, const Pose& mesh_in_blisk, std::uint32_t triangle,
                          int blade) {
  if (blade == 0) return {};
  const Triangle corners = mesh_in_blisk * mesh.triangle(triangle);
  const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  const Vec3 e_theta(-middle.y(), middle.x(), 0.0);
  return scaledNormal(corners).dot(e_theta) > 0.0 ? "forward" : "backward";
}

/// The channel that a side of a blade bounds: between the blade and the next for its forward side, between
/// the one before and the blade for its backward side, as "3-4"; the last blade's next is the first. Empty
/// for no side.
inline std::string channelOf(const std::string& side, int blade, int blade_count) {
  if (side.empty()) return {};
  const int first = side == "forward" ? blade : blade > 1 ? blade - 1 : blade_count;
  return std::to_string(first) + '-' + std::to_string(first % blade_count + 1);
}

}  // namespace octoblisk::demos
