// The state of a mesh: its defects, what keeps it from bounding a solid, and how its holes can be closed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "octoblisk/mass_properties.h"
#include "octoblisk/surface.h"

namespace octoblisk {

/// Where a defect is: a triangle, and a point of it.
struct DefectPlace {
  std::uint32_t triangle = 0;
  Vec3 position = Vec3::Zero();
};

enum class GapKind {
  hole,        ///< triangles are missing: those around it are sheets
  turned,      ///< no triangle is missing, but those on its two sides face opposite ways: they are sheets
  t_junction,  ///< corners lie on the edge of another triangle, up to the rounding of coordinates to floats
  crack,       ///< narrow compared with the triangles beside it, which bound a solid as if it were not there
  inner,       ///< other parts of the mesh enclose it
};

/// A loop of open edges. An edge is open if triangles use it more often in one direction than in the other.
/// Copies of a triangle count once.
struct MeshGap {
  GapKind kind = GapKind::hole;
  std::vector<Vec3> outline;   ///< its corners, in the direction of the triangles beside it
  std::size_t edges = 0;       ///< the open edges around it
  std::uint32_t triangle = 0;  ///< the lowest one beside it, at the first two corners
  double length = 0.0;         ///< around it
  double width = 0.0;          ///< of a T-junction or crack
  Vec3 center = Vec3::Zero();  ///< the mean of its corners
  double area = 0.0;           ///< of the outline, projected to its plane
  double off_plane = 0.0;      ///< the greatest distance of a corner from that plane
  bool is_planar = false;      ///< the corners are in the plane as far as closeHoles demands
};

/// What inspect finds. Lists of places are complete, in ascending order of triangles. The place of a triangle
/// is its centroid, that of an edge its middle.
struct MeshInspection {
  std::size_t triangles = 0;
  std::size_t components = 0;  ///< sets of triangles connected by corners
  std::size_t shells = 0;      ///< components that enclose a solid
  std::size_t hollows = 0;     ///< components that enclose a hollow in a solid

  std::vector<MeshGap> gaps;             ///< by kind; of one kind, the longest first
  std::vector<DefectPlace> t_junctions;  ///< corners on the edge of another triangle; the place is the corner
  std::vector<DefectPlace> copies;       ///< triangles with the same three corners as a lower one
  std::vector<DefectPlace> zero_area;
  std::vector<DefectPlace> shared_edges;   ///< edges of more than two triangles; copies count once
  std::vector<DefectPlace> opposed_edges;  ///< edges of two triangles that face opposite ways
  std::vector<DefectPlace> intersecting;   ///< triangles that others cut or overlap
  /// Triangles of parts that face inward: the winding number is negative in the solid that they bound.
  std::vector<DefectPlace> inward;
  /// Triangles on others that face the other way, where the surface is folded over and back.
  std::vector<DefectPlace> folded;
  std::vector<DefectPlace> inner;   ///< those with the role TriangleRole::inner that have an area
  std::vector<DefectPlace> sheets;  ///< those with the role TriangleRole::sheet

  bool is_closed = false;  ///< Surface::isClosed
  /// Whether some triangles face out of a solid and see no hole in more than 1/64 of all directions. Only
  /// these push bodies out in Bullet, because through larger holes bodies get in.
  bool pushes_out = false;
  MassProperties mass;  ///< of the bounding box if the mesh is not closed

  /// The gaps of a kind, and the open edges around them.
  std::size_t count(GapKind kind) const;
  std::size_t openEdges(GapKind kind) const;

  /// Whether some triangles bound a solid.
  bool isAnywhereSolid() const { return sheets.size() + inner.size() + zero_area.size() < triangles; }
  /// Whether the triangles that bound a solid face inward, all but a few.
  bool facesInward() const;
  /// Whether the whole mesh bounds a solid and faces outward. Then inside, depth, inertia and Bullet's
  /// contacts are those of the solid everywhere, whatever other defects the mesh has.
  bool isSolid() const { return is_closed && mass.is_solid && sheets.empty() && inward.empty(); }
};

/// Examines a mesh. O(n log n).
MeshInspection inspect(const Surface& surface);

/// What keeps a mesh from bounding a solid and facing outward everywhere, in one sentence: "The mesh has 2
/// holes, the longest with 96 edges beside triangle 17 at (0 0 5)." Empty if nothing does.
std::string whyNotSolid(const MeshInspection& inspection);

/// Triangles that fill a hole, or several: a missing ring has an outline inside another.
struct HoleCap {
  std::size_t outlines = 0;
  std::size_t edges = 0;       ///< of all outlines
  std::size_t triangles = 0;   ///< added
  std::uint32_t triangle = 0;  ///< one that was beside the hole
  Vec3 center = Vec3::Zero();  ///< of the greatest outline
  double area = 0.0;
};

struct ClosedMesh {
  TriangleMesh mesh;  ///< the triangles of the source, and then those of the caps, at the same vertices
  std::vector<HoleCap> added;
  /// The holes that are still open: those that are not planar, and those whose outline crosses itself.
  std::vector<MeshGap> refused;
};

/// Closes the planar holes of a mesh, for example a bore that was left open. A hole is planar if all its
/// corners are within 1e-4 of its size (the diagonal of its bounds) from one plane. Files with six digits
/// round by 1e-6 of the coordinates, which may be a hundred times as large as the hole. Gaps of other kinds
/// stay as they are.
ClosedMesh closeHoles(const Surface& surface);

}  // namespace octoblisk
