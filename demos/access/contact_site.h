// Points on a blade's side for the belt to grind, and the tool's orientations at each of them.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "models/blade_finder.h"
#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

/// Lengths in mm, in the blisk's frame.
struct ContactSite {
  std::size_t pose = 0;                                   ///< of the path, if the point comes from one
  Vec3 point = Vec3::Zero();                              ///< on the blade
  Vec3 normal = Vec3::UnitX();                            ///< unit, outwards
  Pose base;                                              ///< of the tool, at tilt 0 and lead 0
  double height = 0.0;                                    ///< above the blade's root radius
  double arc = std::numeric_limits<double>::quiet_NaN();  ///< along the section at the point's radius, from
                                                          ///< the leading edge; NaN: unknown
  double half_width = 0.0, half_height = 0.0;             ///< of its cell in a map of arc length and height
};

/// The tool turned by the tilt about its wheels' axis, z through its origin, and by the lead about the normal
/// through the point; in degrees. Neither turn moves a cylindrical contact wheel off the point.
///
/// A positive tilt turns the arm (x) towards the tool's y, which at tilt 0 of a grid is the outward normal. A
/// positive lead turns an arm that lies along the surface towards the wheels' axis (z).
Pose tiltedPose(const ContactSite& site, double tilt_degrees, double lead_degrees);

struct SiteGridOptions {
  int blade = 1;
  bool forward_side = true;      ///< the side that faces towards greater angles about Z
  int rows = 25;                 ///< over the height
  int columns = 40;              ///< along the section
  double span_from = 0.1;        ///< lowest row, as a fraction of the height: root 0, tip 1
  double span_to = 0.95;         ///< highest row
  double clear_of_edges = 0.05;  ///< fraction of the arc length left out at each edge
  double wheel_radius = 9.5;     ///< of the contact wheel with the belt on it
  double depth = 0.02;           ///< to which the belt is pressed into the surface
};

/// Points equally spaced over radius and along the sections. At its base pose the arm lies along the surface,
/// away from the axis, and the wheels' axis points downstream: as in grinding_path.h without lean. Radii at
/// which the blade has no closed section are left out. Throws std::invalid_argument with a one-line message:
/// no such blade, an option out of range, no point at all.
std::vector<ContactSite> sitesOnBlade(const TriangleMesh& blisk, const BladesFound& blades,
                                      const SiteGridOptions& options);

/// The poses of a path at which the belt touches the blade, or comes within `reach` (mm) of it. The point is
/// the blade's nearest point to the tool's origin; the base pose is the path's. Throws std::invalid_argument
/// if the blade does not exist.
std::vector<ContactSite> sitesOfPath(const TriangleMesh& blisk, const BladesFound& blades, int blade,
                                     const ClusteredOctree& belt, std::span<const Pose> path,
                                     double reach = 0.5);

}  // namespace octoblisk::demos
