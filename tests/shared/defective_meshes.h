// Meshes of solids with the defects that real files have, and the truth about these solids.
#pragma once

#include <string>
#include <vector>

#include "shared/meshes.h"

namespace octoblisk::testing {

/// The mass properties of a solid of density 1 and mass 1.
struct Moments {
  double volume = 0.0;
  Vec3 center = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};

struct DefectiveMesh {
  std::string name;
  SharedMesh mesh;
  /// The boundary of the solid that the mesh stands for. It may have T-junctions, but no other defects. Null
  /// if the mesh stands for no solid.
  SharedMesh clean;
  bool is_closed = true;  ///< what Surface::isClosed should say
  bool is_whole = false;  ///< what Surface::isWhole should say
  /// Whether the winding number, rounded, tells the solid, apart from what is within the gap. Where walls
  /// that lie on each other have cracks, it is 0 in pockets between them.
  bool is_faithful = true;
  double gap = 0.0;     ///< the surfaces of mesh and solid are this close to each other, except at holes
  double volume = 0.0;  ///< of the solid, in closed form; 0 if there is none

  double size() const { return clean->bounds().halfExtents().norm(); }

  // The truth about the solid, by brute force over the triangles of `clean`.
  bool contains(const Vec3& point) const;
  double distanceToBoundary(const Vec3& point) const;
  Moments moments() const;
};

/// Each kind of defect by itself.
std::vector<DefectiveMesh> defectiveMeshes();

/// Two kinds of defects in one mesh.
std::vector<DefectiveMesh> twiceDefectiveMeshes();

/// Scales and then moves the mesh and the solid.
DefectiveMesh moved(const DefectiveMesh& mesh, const Pose& pose, double scale);

/// The mesh with each triangle once, on the side that more of its copies face; without those that have as
/// many copies on both sides.
SharedMesh withoutCopies(const TriangleMesh& mesh);

/// The winding number as `windingNumber` in shared/solids.h computes it, but in long double.
double preciseWindingNumber(const TriangleMesh& mesh, const Vec3& point);

}  // namespace octoblisk::testing
