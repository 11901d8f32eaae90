// The axis about which the blades of a mesh stand, wherever the mesh lies in space.
#pragma once

#include "models/blade_finder.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// A line with a direction, in the mesh's frame. The blades' leading edges are taken to be at its lesser end.
struct BliskAxis {
  Vec3 direction = Vec3::UnitZ();  ///< of length 1
  Vec3 point = Vec3::Zero();       ///< on the axis
};

/// Takes points of the mesh's frame to the blisk's: its axis is Z, its origin the point of the axis nearest
/// to the mesh's, and its X axis goes as near to the mesh's X axis (Y, where the axis is near X) as it can.
/// The identity for the default axis. Throws std::invalid_argument where the direction has no length or a
/// coordinate is not finite.
Pose meshInBlisk(const BliskAxis& axis);

/// The mesh in another frame.
TriangleMesh moved(const TriangleMesh& mesh, const Pose& pose);

/// A mesh's blades and the axis that they stand about. Radii are from that axis.
struct BliskFound {
  BliskAxis axis;
  Pose mesh_in_blisk;
  BladesFound blades;
  /// How far any blade's vertex lies off the mesh when it is turned by one pitch, at most. Mesh units.
  double repeat_error = 0.0;
};

/// Finds the axis and the blades. Tried are the mesh's Z axis, then the principal axes of its surface through
/// its centroid, the roundest first: of a surface that repeats about an axis three times or more, that axis
/// is one, and the moments about the other two are equal. An axis on which blades are found (findBlades) is
/// made better by the blades' centroids, the corners of a regular polygon, and must then prove right: turned
/// by one pitch, the blades must lie on the mesh within 0.5 % of their tip radius. Of an axis found this way
/// the greatest coordinate is above 0.
///
/// Throws std::invalid_argument in one line where no axis does.
BliskFound findBlisk(const TriangleMesh& mesh);

/// The same about a known axis, which is taken as it is.
BliskFound findBlisk(const TriangleMesh& mesh, const BliskAxis& axis);

}  // namespace octoblisk::demos
