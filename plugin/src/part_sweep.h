// When two parts of moving bodies first come near each other.
#pragma once

#include <LinearMath/btScalar.h>

#include <optional>

#include "body_parts.h"
#include "octoblisk/sweep.h"

namespace octoblisk::detail {

/// The tolerance given to the sweep of two parts, in which their margins are. Of `tolerance`, default
/// included, timeOfImpact says what it is.
double sweepTolerance(const MovingBody& body_a, const BodyPart& a, const MovingBody& body_b,
                      const BodyPart& b, btScalar tolerance = -1);

/// The sweep of two parts, one or both of which are ours. Points of the clearance are in the world; a convex
/// part has no triangle.
std::optional<TimeOfImpact> sweepParts(const BodyPart& a, const BodyPart& b, double tolerance,
                                       const SweepOptions& options = {});

}  // namespace octoblisk::detail
