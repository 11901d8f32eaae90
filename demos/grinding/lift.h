// Lifts a part off a solid to prove a bound of their depths.
#pragma once

#include "octoblisk/surface.h"

namespace octoblisk::demos {

/// For two surfaces that do not meet: true if any part of one lies in the other. An open B contains nothing.
bool areNested(const octoblisk::Surface& a, const octoblisk::Surface& b, const Pose& b_in_a);

/// The same if caps close the gaps of A, and B does not meet these either.
bool areNestedIfCapped(const octoblisk::Surface& a, const octoblisk::Surface& b, const Pose& b_in_a);

/// True if the part is farther than `depth` (mm) from the caps of the solid's gaps, and if the part, shifted
/// by `depth` along `up` (of unit length) or in one of four directions 17° off it, does not meet the solid,
/// lie in it or contain it. Then no point of either is deeper in the other than `depth`: around a deeper
/// point there is a ball of its depth inside the solid, and the shift does not leave that ball.
bool partsWhenLifted(const octoblisk::Surface& solid, const octoblisk::Surface& part,
                     const Pose& part_in_solid, const Vec3& up, double depth);

}  // namespace octoblisk::demos
