// A mesh that bodies collide with, as a solid.
#pragma once

#include "octoblisk/surface.h"

namespace octoblisk::detail {

/// What contacts need to know about the solid that a mesh bounds. A reference: the mesh must outlive it.
class SolidMesh {
 public:
  enum class Kind {
    sheet,   ///< no triangle bounds a solid
    simple,  ///< all triangles do (simple_solid.h)
  };
  SolidMesh(const ClusteredOctree& tree, Kind kind) : boundary_(&tree), is_sheet_(kind == Kind::sheet) {}
  explicit SolidMesh(const Surface& surface) : boundary_(&surface.boundary()), surface_(&surface) {}

  /// Whether at least some triangles may bound a solid.
  bool isAnywhereSolid() const { return !is_sheet_; }

  /// Whether nothing gets inside without crossing a triangle.
  bool isClosed() const { return !is_sheet_ && (!surface_ || surface_->isClosed()); }

  /// The triangles that bodies can touch: those of Surface::boundary.
  const ClusteredOctree& boundary() const { return *boundary_; }
  /// The mesh's triangle that a triangle of the boundary is, or is a part of.
  std::uint32_t sourceOf(std::uint32_t triangle) const {
    return surface_ ? surface_->sourceOf(triangle) : triangle;
  }
  /// Whether a triangle of the boundary bounds a solid and faces outward, and no hole nearby lets bodies in.
  /// What is in an open box must not be pushed out through its walls.
  bool boundsSolid(std::uint32_t triangle) const;
  bool boundsAnywhere() const;
  bool boundsEverywhere() const;
  /// Whether a point is inside, and the nearest triangle shows the way out. The point is in a frame in which
  /// the mesh has a pose. Allocates nothing.
  bool contains(const Vec3& point, const Pose& mesh_in_a = {}) const;

 private:
  const ClusteredOctree* boundary_;
  const Surface* surface_ = nullptr;  // null: all triangles have the same role
  bool is_sheet_ = false;
};

}  // namespace octoblisk::detail
