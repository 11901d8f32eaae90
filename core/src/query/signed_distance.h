// The two halves of the signed distance: of solids apart, and of one in the other.
#pragma once

#include "octoblisk/depth.h"
#include "octoblisk/distance.h"
#include "octoblisk/signed_distance.h"

namespace octoblisk::detail {

/// The tolerance that depths are found to.
double depthTolerance(const Surface& a, const Surface& b, const SignedDistanceOptions& options);

/// Of surfaces that do not meet.
SignedDistance signedDistanceOf(const Clearance& clearance, const Pose& b_in_a);

/// Of B's deepest point in A, found to the tolerance.
SignedDistance signedDistanceOf(const GougeDepth& of_b, const Surface& a, const Surface& b,
                                const Pose& b_in_a, double tolerance);

/// The same with the names of the two exchanged: of A in B's frame, told of B in A's.
SignedDistance exchanged(const SignedDistance& of_a_in_b, const Pose& b_in_a);

}  // namespace octoblisk::detail
