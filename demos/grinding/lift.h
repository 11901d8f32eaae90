// Lifting a part off a solid: what that proves of their depths.
#pragma once

#include "octoblisk/solid_boundary.h"
#include "octoblisk/surface.h"

namespace octoblisk::demos {

/// Of two surfaces that do not meet: whether any part of one lies in the other, or that is not known. An open
/// B holds nothing.
bool mayBeNested(const SolidBoundary& a, const octoblisk::Surface& b, const Pose& b_in_a);

/// Of a solid whose boundary is whole: whether the part, shifted by `depth` (mm) along `up` (of unit length)
/// or in one of four directions 17° off it, neither meets the solid nor lies in it, nor holds it. Then no
/// point of either is deeper in the other than that: about one that is, a ball of its depth lies inside, and
/// the shift does not lead out of it.
bool partsWhenLifted(const SolidBoundary& solid, const octoblisk::Surface& part, const Pose& part_in_solid,
                     const Vec3& up, double depth);

}  // namespace octoblisk::demos
