// A few points around the core of a convex body.
#pragma once

#include <array>
#include <span>

#include "octoblisk/convex.h"

namespace octoblisk::detail {

inline constexpr std::size_t kMaxCorePoints = HullFaceList::kMaxPoints;

/// A few points whose hull contains a body's core: the body's own points, or the corners of the core's box,
/// written to `room`.
inline std::span<const Vec3> corePoints(const Convex& convex, std::array<Vec3, 8>& room) {
  const std::span<const Vec3> points = convex.points();
  if (!points.empty() && points.size() <= kMaxCorePoints) return points;
  room = convex.coreBounds().corners();
  return room;
}

}  // namespace octoblisk::detail
