// Finds the blade of each triangle of a blisk from the mesh alone.
#pragma once

#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// The blades of a mesh, or none. Radii are from the Z axis, in mesh units.
struct BladesFound {
  int count = 0;
  std::vector<int> blade_of_triangle;  ///< 1..count; 0 for hub, shroud or unknown
  double root_radius = 0.0;            ///< the hub's greatest radius: beyond it the blades are separate
  double tip_radius = 0.0;             ///< the greatest radius of a blade
  bool shrouded = false;               ///< whether a ring joins the blades at their tips
};

/// Finds equal parts spaced equally around the Z axis: the parts into which the mesh falls beyond some
/// radius, and below a shroud if there is one. The result that holds over the widest range of radii counts;
/// it must hold over 5 % of the mesh's radii. Down to the hub and up to the shroud, a blade takes all
/// connected triangles that are not part of a surface of revolution: |normal · e_theta| > 0.05, or more for
/// large triangles.
///
/// Blades are numbered towards greater angles, from the one whose leading edge (least z) has its tip nearest
/// to angle 0; `makeBlisk` numbers them likewise. Vertices at equal coordinates count as one; the mesh may be
/// open, and blades may reach into the hub without sharing vertices with it.
///
/// Parts that are not at least three times as high as thick are not blades: for example the four edges of a
/// square bar, or the teeth of a gear.
///
/// Without blades, the count, all triangles' blades and both radii are 0. Blades of several kinds (splitters)
/// are not found.
BladesFound findBlades(const TriangleMesh& mesh);

}  // namespace octoblisk::demos
