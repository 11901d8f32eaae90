// Which triangles of a mesh bound a solid, and what its surface is.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/open_loops.h"
#include "octoblisk/surface.h"
#include "query/winding.h"

namespace octoblisk::detail {

/// An open edge by its ends, and a triangle beside it.
struct GapEdge {
  Vec3 from, to;
  std::uint32_t triangle;
};

/// A loop of open edges, and the triangles that close it.
struct Gap {
  std::vector<GapEdge> edges;
  std::vector<Triangle> cap;
  bool is_inner = false;  // other parts of the mesh enclose its cap
  bool is_hole = false;   // a triangle at one of its edges is a sheet because of it
};

/// The boundary of a solid, if not all triangles of a mesh belong to it as they are.
struct BoundarySurface {
  explicit BoundarySurface(ClusteredOctree of_boundary) : tree(std::move(of_boundary)) {}
  ClusteredOctree tree;
  std::unique_ptr<const Surface> surface;  // only its corners, stars and components are known
  std::vector<std::uint32_t> source;       // per triangle: the triangle that it is a part of
  /// Per triangle: its share of the surface. Where k equal facets lie on each other, each has a k-th.
  /// Negative if it faces into the solid, 0 for sheets.
  std::vector<double> share;
};

/// What Surface knows about the solid that its mesh bounds.
struct SolidParts {
  explicit SolidParts(Winding of_mesh) : winding(std::move(of_mesh)) {}

  /// Examines the mesh, whose corners are known, and fills the surface's roles and this.
  static std::shared_ptr<const SolidParts> of(Surface& surface, int threads);

  Winding winding;  // copies count once
  std::vector<Gap> gaps;
  /// Per triangle: whether a hole that it sees, or that is at its edge, lets bodies in; empty if none does.
  std::vector<char> near_hole;
  std::vector<std::uint32_t> copies;          // triangles with the same corners as a lower one, ascending
  std::vector<std::uint32_t> intersecting;    // the triangles that others cut, ascending
  std::unique_ptr<BoundarySurface> boundary;  // null: all triangles as they are
};

/// The surface of Surface::boundary.
inline const Surface& boundaryOf(const Surface& surface) {
  const auto& boundary = surface.solidParts().boundary;
  return boundary ? *boundary->surface : surface;
}

}  // namespace octoblisk::detail
