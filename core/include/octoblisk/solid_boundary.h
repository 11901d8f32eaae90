// Where a surface bounds a solid: what inside and outside mean near a surface that has holes or meets itself.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "octoblisk/closest_point.h"
#include "octoblisk/containment.h"
#include "octoblisk/surface.h"

namespace octoblisk {

/// Knows of each triangle of a surface whether it bounds a solid:
///   1. each of its edges belongs to one other triangle, which uses it the other way;
///   2. it meets no triangle that shares no corner with it;
///   3. just outside of it the winding number is about 0: it lies within no other part of the surface.
/// So the triangles at open edges, at edges of more than two triangles (doubled surfaces), where the surface
/// meets itself, and those within a solid that another part bounds are none. Of degenerate triangles, none
/// is.
///
/// Built once, in O(n log n) and a winding number, O(n), for each region that hangs together by edges of such
/// triangles. Only the kMostRegions largest are asked; the triangles of the rest bound nothing.
class SolidBoundary {
 public:
  static constexpr std::size_t kMostRegions = 128;

  /// The surface must outlive it. `threads`: 0 for as many as the machine has; the answers are the same.
  explicit SolidBoundary(const Surface& surface, int threads = 0);
  explicit SolidBoundary(Surface&&, int = 0) = delete;

  const Surface& surface() const { return *surface_; }

  /// Whether every triangle meets 1 and 2. Then the surface is closed, and octoblisk::locate says where points
  /// lie, whichever way it faces.
  bool isWhole() const { return whole_; }

  /// Whether the triangle bounds a solid; of a whole surface every one does.
  bool has(std::uint32_t triangle) const { return whole_ || bounds_[triangle] != 0; }

  /// Where a point lies. Of a whole surface as octoblisk::locate says. Else by the side of the pseudonormal (J. A.
  /// Bærentzen, H. Aanæs, Signed distance computation using the angle weighted pseudonormal, IEEE TVCG 11
  /// (3), 2005) of the nearest point, if that lies amid triangles that bound a solid. Where it does not, by
  /// the winding number, if that is within 1/4 of 0 or 1; else unknown.
  PointLocation locate(const Vec3& point) const;
  /// The same, faster: `nearest` is the surface's closest point to it. Of a whole surface, too, by the
  /// pseudonormal where 3 is met; within rounding of the surface that may differ from the exact answer.
  PointLocation locate(const Vec3& point, const ClosestPoint& nearest) const;

 private:
  /// Of the feature (face, edge or vertex) that the point lies on; none if not all about it bounds a solid.
  std::optional<Vec3> pseudonormal(const ClosestPoint& at) const;
  void findGoodEdges();
  void findMeetings();
  void findRegions(int threads);

  const Surface* surface_;
  bool whole_ = false;
  std::vector<char> bounds_;  // of each triangle: whether it meets 1, 2 and 3
};

}  // namespace octoblisk
