// The two sides of a blade.
#pragma once

#include <cstdint>
#include <string>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// "forward" if a triangle of a blade, oriented outward, faces towards greater angles about the blisk's axis,
/// otherwise "backward"; empty for blade 0, the hub or shroud. `mesh_in_blisk`: to the frame whose Z is the
/// axis.
inline std::string sideOf(const TriangleMesh& mesh, const Pose& mesh_in_blisk, std::uint32_t triangle,
                          int blade) {
  if (blade == 0) return {};
  const Triangle corners = mesh_in_blisk * mesh.triangle(triangle);
  const Vec3 middle = centroidOf(corners);
  const Vec3 e_theta(-middle.y(), middle.x(), 0.0);
  return scaledNormal(corners).dot(e_theta) > 0.0 ? "forward" : "backward";
}

/// The channel that a side of a blade bounds, as "3-4". The forward side bounds the channel to the next
/// blade, the backward side the channel to the previous blade; the last blade's next is the first. Empty if
/// there is no side.
inline std::string channelOf(const std::string& side, int blade, int blade_count) {
  if (side.empty()) return {};
  const int first = side == "forward" ? blade : blade > 1 ? blade - 1 : blade_count;
  return std::to_string(first) + '-' + std::to_string(first % blade_count + 1);
}

}  // namespace octoblisk::demos
