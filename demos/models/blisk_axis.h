// Finds the axis of a blisk's mesh in any position.
#pragma once

#include "models/blade_finder.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// A line with a direction, in the mesh's frame. The leading edges are assumed to be where the axis begins.
struct BliskAxis {
  Vec3 direction = Vec3::UnitZ();  ///< of length 1
  Vec3 point = Vec3::Zero();       ///< on the axis
};

/// The transformation from the mesh's frame to the blisk's: its axis is Z, its origin the point of the axis
/// nearest to the mesh's origin, and its X axis as near as possible to the mesh's X axis (or Y, if the axis
/// is near X). The identity for the default axis. Throws std::invalid_argument if the direction has no length
/// or a coordinate is not finite.
Pose meshInBlisk(const BliskAxis& axis);

/// The mesh in another frame.
TriangleMesh moved(const TriangleMesh& mesh, const Pose& pose);

/// A mesh's blades and their axis. Radii are measured from that axis.
struct BliskFound {
  BliskAxis axis;
  Pose mesh_in_blisk;
  BladesFound blades;
  /// The greatest distance of a blade's vertex from the mesh after rotation by one pitch, in mesh units.
  double repeat_error = 0.0;
};

/// Finds the axis and the blades. It tries the mesh's Z axis, then the principal axes of its surface through
/// its centroid, the roundest first: if a surface repeats about an axis at least three times, that axis is a
/// principal axis, and the moments about the other two are equal. An axis with blades (findBlades) is refined
/// by the blades' centroids, which are the corners of a regular polygon. It must then pass a test: rotated by
/// one pitch, the blades must match the mesh within 0.5 % of their tip radius. The greatest coordinate of an
/// axis found this way is positive.
///
/// Throws std::invalid_argument with a one-line message if no axis passes.
BliskFound findBlisk(const TriangleMesh& mesh);

/// The same about a known axis, which is used unchanged.
BliskFound findBlisk(const TriangleMesh& mesh, const BliskAxis& axis);

}  // namespace octoblisk::demos
