// Where a surface bounds a solid: defines inside and outside near a surface with holes or self-intersections.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "octoblisk/closest_point.h"
#include "octoblisk/containment.h"
#include "octoblisk/surface.h"

namespace octoblisk {

/// Knows which triangles of a surface bound a solid. A triangle bounds a solid if
///   1. each of its edges belongs to one other triangle, which uses it the other way;
///   2. it intersects only triangles that share a corner with it;
///   3. just outside of it the winding number is about 0: it lies within no other part of the surface.
/// Therefore these triangles bound nothing: triangles at open edges or at edges of more than two triangles
/// (doubled surfaces), triangles that intersect the surface, triangles inside a solid that another part
/// bounds, and degenerate triangles.
///
/// Built once, in O(n log n) plus O(n) for the winding number of each region. A region is a set of triangles
/// that satisfy 1 and 2 and are connected by edges. Only the 128 largest regions are examined. The triangles
/// of other regions bound nothing.
class SolidBoundary {
 public:
  /// The surface must outlive it. `threads`: 0 for as many as the machine has; the answers do not depend on
  /// it.
  explicit SolidBoundary(const Surface& surface, int threads = 0);
  explicit SolidBoundary(Surface&&, int = 0) = delete;

  const Surface& surface() const { return *surface_; }

  /// Whether 1 and 2 hold for every triangle. Then the surface is closed, and octoblisk::locate finds where
  /// points lie, whichever way the surface faces.
  bool isWhole() const { return whole_; }

  /// Whether the triangle bounds a solid. Every triangle of a whole surface does.
  bool has(std::uint32_t triangle) const { return whole_ || bounds_[triangle] != 0; }

  /// Where a point lies. A whole surface answers as octoblisk::locate does. Otherwise the pseudonormal of the
  /// nearest point decides (J. A. Bærentzen, H. Aanæs, Signed distance computation using the angle weighted
  /// pseudonormal, IEEE TVCG 11 (3), 2005) if all triangles at that point bound a solid. If they do not, the
  /// winding number decides if it is within 1/4 of 0 or 1; otherwise the location is unknown.
  PointLocation locate(const Vec3& point) const;
  /// The same, but faster. `nearest` is the surface's point closest to `point`. The pseudonormal also decides
  /// on a whole surface wherever 3 holds; within rounding of the surface, the answer may differ from the
  /// exact one.
  PointLocation locate(const Vec3& point, const ClosestPoint& nearest) const;

 private:
  /// The pseudonormal of the feature (face, edge or vertex) that the point lies on; none if a triangle around
  /// it bounds no solid.
  std::optional<Vec3> pseudonormal(const ClosestPoint& at) const;
  void findGoodEdges();
  void findMeetings();
  void findRegions(int threads);

  const Surface* surface_;
  bool whole_ = false;
  std::vector<char> bounds_;  // per triangle: whether it satisfies 1, 2 and 3
};

}  // namespace octoblisk
