// How a solid of even density resists being moved and turned.
#pragma once

#include "octoblisk/triangle_mesh.h"

namespace octoblisk {

/// Volume, centre of mass and inertia of a solid of even density. Lengths in mesh units; the inertia is that
/// of mass 1 (length²), so that a flat box has one too.
struct MassProperties {
  /// False: the mesh encloses no solid, and these are the properties of its solid bounding box.
  bool is_solid = false;
  double volume = 0.0;
  Vec3 center_of_mass = Vec3::Zero();
  /// ∫ (|x|² 1 − x xᵀ) dV / volume, x from the centre of mass, along the mesh's axes.
  Mat3 inertia = Mat3::Zero();

  /// The inertia of mass 1 about another point (parallel axes).
  Mat3 inertiaAbout(const Vec3& point) const;
};

/// Those of the solid that the mesh bounds, in O(n), exact but for rounding: the sum over the tetrahedra of
/// each triangle and a point amid the mesh, with their sign (C. Zhang, T. Chen, Efficient Feature Extraction
/// for 2D/3D Objects in Mesh Representation, 2001). Parts of the solid that overlap count as often as they
/// do; an inner surface facing the other way is a cavity; a mesh that faces inward as a whole is turned.
///
/// Where the mesh is open, not consistently oriented (isOrientedClosed), or of no volume: those of the
/// solid bounding box of its triangles.
MassProperties massProperties(const TriangleMesh& mesh);

/// Whether every edge, by the positions of its ends, is used as often one way as the other: what
/// Surface::isOriented says, in O(n) and without memory of the edges, by comparing sums of 64-bit hashes of
/// the edges of either way. Meshes that were not made to deceive it do so with a chance of 2⁻⁶⁴.
bool isOrientedClosed(const TriangleMesh& mesh);

/// The frame in which the inertia is diagonal.
struct PrincipalFrame {
  Pose in_mesh;                 ///< origin: the centre of mass; columns: the axes, by ascending moment
  Vec3 moments = Vec3::Zero();  ///< of mass 1 about the axes
};
PrincipalFrame principalFrame(const MassProperties& properties);

}  // namespace octoblisk
