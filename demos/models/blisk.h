// Generates bladed disks: hub, blades and an optional shroud as one closed mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "models/blade_sections.h"
#include "models/radius_profile.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// Lengths in mm, axis of rotation Z.
struct BliskOptions {
  int blade_count = 24;
  double bore_radius = 60.0;
  std::size_t target_triangles = 50'000;  ///< met within 15 % from 10,000 triangles up
  bool shroud = false;                    ///< a ring that joins the blades' tips
  double shroud_thickness = 4.0;          ///< radial, outwards from the tips
  double shroud_overhang = 6.0;           ///< axial, beyond the tips' leading and trailing edges
};

/// A closed mesh, oriented outward, that bounds one solid.
struct Blisk {
  TriangleMesh mesh;
  std::vector<int> blade_of_triangle;  ///< 1..blade_count; 0 for hub and shroud
};

/// Builds a blisk from the blade of the sections, repeated about Z from blade 1 towards greater angles, on a
/// hub between the profile's first and last z. Hub, blades and shroud share their vertices: every edge
/// belongs to two triangles, and the blades' root loops lie exactly on the hub surface.
///
/// Throws std::invalid_argument with a one-line message for input that does not make a blisk: a size not
/// above 0, a bore outside the hub, blades that touch each other or reach beyond the hub's ends, a tip below
/// the hub, a target of triangles too small for the blades.
Blisk makeBlisk(const BladeSections& sections, const RadiusProfile& hub, const BliskOptions& options = {});

/// The default blisk, 480 × 480 × 200 mm overall: 24 default blades on a cylinder of radius 128 mm.
Blisk makeDefaultBlisk(std::size_t target_triangles = 50'000);

}  // namespace octoblisk::demos
