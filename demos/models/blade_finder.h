// Which triangles of a blisk's mesh belong to which blade, found from the mesh alone.
#pragma once

#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// The blades of a mesh, or none. Radii are from the Z axis, in mesh units.
struct BladesFound {
  int count = 0;
  std::vector<int> blade_of_triangle;  ///< 1..count; 0 for hub, shroud or not known
  double root_radius = 0.0;            ///< the hub's greatest: beyond it the blades stand apart
  double tip_radius = 0.0;             ///< the greatest of a blade
  bool shrouded = false;               ///< whether a ring joins the blades at their tips
};

/// Finds equal parts spaced equally round the Z axis: those the mesh falls into beyond some radius, and
/// below a shroud if there is one. What holds over the widest range of radii counts; it must hold over 5 % of
/// the radii of the mesh. Down to the hub and up to the shroud a blade takes all triangles that hang together
/// with it and are not of a surface of revolution: |normal · e_theta| > 0.05, or more where triangles are
/// large.
///
/// Blades are numbered towards greater angles, from the one whose leading edge (least z) has its tip nearest
/// to angle 0: the numbers of `makeBlisk`. Vertices at equal coordinates count as one; the mesh need not be
/// closed, and blades may reach into the hub without sharing vertices with it.
///
/// Parts that are not at least three times as high as they are thick are no blades: the four edges of a
/// square bar, say, or the teeth of a gear.
///
/// Where there are no blades, the count is 0, all triangles are 0 and both radii are 0. Blades of several
/// kinds (splitters) are not found.
BladesFound findBlades(const TriangleMesh& mesh);

}  // namespace octoblisk::demos
