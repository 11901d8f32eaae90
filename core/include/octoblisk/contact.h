// The results of queries about two bodies A and B: where, in which direction, how far, and which triangles.
#pragma once

#include <cstdint>

#include "octoblisk/types.h"

namespace octoblisk {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

/// The indices of two triangles.
struct TrianglePair {
  std::uint32_t a = kNoTriangle;
  std::uint32_t b = kNoTriangle;
  bool operator==(const TrianglePair&) const = default;
  auto operator<=>(const TrianglePair&) const = default;  // NOLINT(modernize-use-nullptr): a false alarm
};

/// A contact of two bodies that touch or are near each other. Points and normal are in A's frame.
struct Contact {
  Vec3 point_on_a = Vec3::Zero();
  Vec3 point_on_b = Vec3::Zero();
  Vec3 normal = Vec3::UnitX();             ///< unit, from B to A: moving A along it separates the bodies
  double distance = 0.0;                   ///< > 0: clearance; <= 0: touching, or minus the depth; mesh units
  std::uint32_t triangle_a = kNoTriangle;  ///< index in A's mesh
  std::uint32_t triangle_b = kNoTriangle;  ///< index in B's mesh; kNoTriangle if B is convex

  TrianglePair triangles() const { return {triangle_a, triangle_b}; }
};

}  // namespace octoblisk
