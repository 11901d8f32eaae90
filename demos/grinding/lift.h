// Lifts a part off a solid to prove a bound of their depths.
#pragma once

#include "octoblisk/solid_boundary.h"
#include "octoblisk/surface.h"

namespace octoblisk::demos {

/// For two surfaces that do not meet: true if any part of one lies in the other, or if this is unknown. An
/// open B contains nothing.
bool mayBeNested(const SolidBoundary& a, const octoblisk::Surface& b, const Pose& b_in_a);

/// For a solid whose boundary has no defects: true if the part, shifted by `depth` (mm) along `up` (of unit
/// length) or in one of four directions 17° off it, does not meet the solid, lie in it or contain it. Then no
/// point of either is deeper in the other than `depth`: around a deeper point there is a ball of its depth
/// inside the solid, and the shift does not leave that ball.
bool partsWhenLifted(const SolidBoundary& solid, const octoblisk::Surface& part, const Pose& part_in_solid,
                     const Vec3& up, double depth);

}  // namespace octoblisk::demos
