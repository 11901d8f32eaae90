// When two parts of moving bodies first come near each other.
#pragma once

#include <LinearMath/btScalar.h>

#include <optional>

#include "body_parts.h"
#include "octoblisk/sweep.h"

namespace octoblisk::detail {

/// The tolerance for the sweep of two parts; it includes their margins. `tolerance` is that of timeOfImpact;
/// below 0, the default.
double sweepTolerance(const MovingBody& body_a, const BodyPart& a, const MovingBody& body_b,
                      const BodyPart& b, btScalar tolerance = -1);

/// The sweep of two parts; at least one is ours. The slack is a fraction of the tolerance without the
/// margins. Points of the clearance are in the world. A convex part has no triangle.
std::optional<TimeOfImpact> sweepParts(const BodyPart& a, const BodyPart& b, double tolerance,
                                       const SweepOptions& options);

}  // namespace octoblisk::detail
