// The mass properties of a solid of uniform density.
#pragma once

#include "octoblisk/triangle_mesh.h"

namespace octoblisk {

/// Volume, centre of mass and inertia of a solid of uniform density. Lengths are in mesh units. The inertia
/// is that of a body of mass 1 (length²), so that a flat box has one too.
struct MassProperties {
  /// False if the mesh encloses no solid. The properties are then those of its solid bounding box.
  bool is_solid = false;
  double volume = 0.0;
  Vec3 center_of_mass = Vec3::Zero();
  /// ∫ (|x|² 1 − x xᵀ) dV / volume, with x from the centre of mass, along the mesh's axes.
  Mat3 inertia = Mat3::Zero();
  /// Whether the mesh as a whole faces inward. The other properties are then those of the reversed mesh.
  bool faces_inward = false;

  /// The inertia of mass 1 about another point (parallel axis theorem).
  Mat3 inertiaAbout(const Vec3& point) const;
};

/// The mass properties of the solid that the mesh bounds, in O(n), exact up to rounding. Sums the signed
/// tetrahedra between each triangle and a point amid the mesh (C. Zhang, T. Chen, Efficient Feature
/// Extraction for 2D/3D Objects in Mesh Representation, 2001). Where parts of the solid overlap, each of them
/// counts. An inner surface that faces the other way is a cavity.
///
/// If the mesh is open, not consistently oriented (Surface::isOriented), or has no volume, returns the
/// properties of the solid bounding box of its triangles.
MassProperties massProperties(const TriangleMesh& mesh);

/// The frame in which the inertia is diagonal.
struct PrincipalFrame {
  Pose in_mesh;                 ///< origin: the centre of mass; columns: the axes, smallest moment first
  Vec3 moments = Vec3::Zero();  ///< of mass 1 about the axes
};
PrincipalFrame principalFrame(const MassProperties& properties);

}  // namespace octoblisk
