// The mass properties of a solid of uniform density.
#pragma once

#include "octoblisk/surface.h"

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
/// tetrahedra between each triangle and the middle of the mesh (C. Zhang, T. Chen, Efficient Feature
/// Extraction for 2D/3D Objects in Mesh Representation, 2001). Each point inside counts once (containment.h),
/// however often the mesh encloses it. Hollows do not count.
///
/// If the mesh has holes (Surface::isClosed) or no volume, returns the properties of the solid bounding box
/// of its triangles.
MassProperties massProperties(const Surface& surface);

/// The same for a mesh alone. Builds a tree and a surface if the mesh is not known to be simple: with each
/// edge in two triangles, which use it in opposite directions, and with components whose bounds are apart. A
/// simple mesh is assumed not to intersect itself.
MassProperties massProperties(const TriangleMesh& mesh);

/// The frame in which the inertia is diagonal.
struct PrincipalFrame {
  Pose in_mesh;                 ///< origin: the centre of mass; columns: the axes, smallest moment first
  Vec3 moments = Vec3::Zero();  ///< of mass 1 about the axes
};
PrincipalFrame principalFrame(const MassProperties& properties);

}  // namespace octoblisk
