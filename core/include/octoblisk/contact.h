// What a query says of two bodies A and B: where, which way, how far, which triangles.
#pragma once

#include <cstdint>

#include "octoblisk/types.h"

namespace octoblisk {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

/// A contact, or a near miss. Points and normal are in the frame of A.
struct Contact {
  Vec3 point_on_a = Vec3::Zero();
  Vec3 point_on_b = Vec3::Zero();
  Vec3 normal = Vec3::UnitX();             ///< unit, from B to A: moving A along it parts the two
  double distance = 0.0;                   ///< > 0 apart, <= 0 touching or as deep; mesh units
  std::uint32_t triangle_a = kNoTriangle;  ///< index in A's mesh
  std::uint32_t triangle_b = kNoTriangle;  ///< index in B's mesh; kNoTriangle where B is convex
};

/// The indices of two triangles that meet.
struct TrianglePair {
  std::uint32_t a = kNoTriangle;
  std::uint32_t b = kNoTriangle;
  bool operator==(const TrianglePair&) const = default;
  auto operator<=>(const TrianglePair&) const = default;  // NOLINT(modernize-use-nullptr): a false alarm
};

}  // namespace octoblisk
