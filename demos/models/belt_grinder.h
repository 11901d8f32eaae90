// Generates the parts of a belt grinder: an abrasive belt, its two wheels and the arm between them.
//
// All parts are in the belt's frame: the contact wheel's centre is the origin, the wheels turn about z, and
// the arm runs along +x to the drive wheel. The belt grinds at the contact wheel, on its -x side. Each part
// is a closed mesh, oriented outward, and does not touch the others. Lengths are in mm.
#pragma once

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// Points of a tool up to this distance from the origin, mm, count as near the grinding place: about the size
/// of a contact wheel.
inline constexpr double kNearGrinding = 30.0;

/// All sizes are assumed, because no source gives them. The numbers of stations and points are those of the
/// paper's belt cloud, 527 · 37 = 19,499 points.
struct BeltParameters {
  double width = 20.0;
  double thickness = 1.5;
  double contact_wheel_radius = 8.0;  ///< of the belt's inner surface
  double drive_wheel_radius = 30.0;   ///< of the belt's inner surface
  double wheel_distance = 300.0;      ///< between the wheels' centres
  int stations = 527;                 ///< along the belt, the first at -x
  int points_per_station = 37;        ///< around the belt's cross-section
  double wheel_gap = 0.05;            ///< between the wheels and the belt's inner surface
  double arm_start = 15.0;            ///< x of the arm's end at the contact wheel
  double arm_width = 16.0;            ///< along z
  double arm_height = 8.0;            ///< along y, between the strands
  double abrasive = 0.5;              ///< thickness of the belt's contact side; the rest is its back
};

/// The belt as a closed band of stations · points_per_station vertices (station by station, each beginning at
/// the outer surface's edge of least z) and twice as many triangles. Half of the stations are spread evenly
/// over its length and half over its turns, so that the facets follow the wheels closely.
///
/// This and the functions below throw std::invalid_argument naming the parameter for sizes that do not make a
/// belt grinder: not above 0, overlapping wheels, or too few stations to go around the wheels.
TriangleMesh makeBelt(const BeltParameters& parameters = {});

/// The belt in two bands that share a surface: the abrasive outer band, which may touch, and its back. Each
/// has the vertices of a belt.
TriangleMesh makeBeltContactSide(const BeltParameters& parameters = {});
TriangleMesh makeBeltBack(const BeltParameters& parameters = {});

TriangleMesh makeContactWheel(const BeltParameters& parameters = {});
TriangleMesh makeDriveWheel(const BeltParameters& parameters = {});

/// A bar between the belt's strands, from arm_start to a little before the drive wheel.
TriangleMesh makeArm(const BeltParameters& parameters = {});

}  // namespace octoblisk::demos
