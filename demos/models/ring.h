// The rings of a blisk, hub and shroud: surfaces of revolution that the blades stand on or reach up to.
#pragma once

#include <vector>

#include "models/blade_surface.h"
#include "models/blisk.h"
#include "models/radius_profile.h"

namespace octoblisk::demos {

/// A piece of a ring's meridian between two corners, straight or along a profile.
struct MeridianLeg {
  double z_start, z_end;
  double radius_start, radius_end;
  const RadiusProfile* along = nullptr;  ///< if set, the radius follows this profile, `lift` farther out
  double lift = 0.0;
  double coarseness = 1.0;  ///< size of its cells, as a multiple of those along the blade

  /// The number of its cells at a spacing along the blade (mm), at least one.
  int cells(double spacing) const;

  /// The point at a fraction 0..1 of the piece, at an angle.
  CylindricalPoint at(double fraction, double angle) const;
};

/// A hub or shroud: the surface with the blades, and the pieces around the ring, beginning at the upstream
/// end.
struct Ring {
  const RadiusProfile& surface;
  std::vector<MeridianLeg> band;  ///< from the row of the leading edges to that of the trailing edges
  int blade_row;                  ///< the blades' row that lies on the surface
  bool faces_axis;                ///< whether the surface with the blades faces the axis
};

/// Along the hub to its front face, down it to the bore, through the bore and up the back face. Cells are
/// coarse where no tool goes. Lengths in mm.
std::vector<MeridianLeg> hubBand(const RadiusProfile& hub, double bore_radius, double z_leading,
                                 double z_trailing);

/// Along the shroud's inner surface to its front end, over the outside and back by its rear end. Lengths in
/// mm.
std::vector<MeridianLeg> shroudBand(const RadiusProfile& inner, const BliskOptions& options, double z_leading,
                                    double z_trailing);

/// The shroud's inner surface: through the middle of the last section, from edge to edge. Throws
/// std::invalid_argument if the middle of that section runs backward in z.
RadiusProfile tipProfile(const BladeGrid& blade);

}  // namespace octoblisk::demos
