// The two cases of the signed distance: solids that are apart, and solids that penetrate each other.
#pragma once

#include "octoblisk/depth.h"
#include "octoblisk/distance.h"
#include "octoblisk/signed_distance.h"

namespace octoblisk::detail {

/// The tolerance of penetration depths.
double depthTolerance(const Surface& a, const Surface& b, const SignedDistanceOptions& options);

/// The signed distance of surfaces that do not meet.
SignedDistance signedDistanceOf(const Clearance& clearance, const Pose& b_in_a);

/// The signed distance given by B's deepest point in A, which is known to within the tolerance.
SignedDistance signedDistanceOf(const GougeDepth& of_b, const Surface& a, const Surface& b,
                                const Pose& b_in_a, double tolerance);

/// The same distance with A and B exchanged: the argument is expressed in B's frame, the result in A's.
SignedDistance exchanged(const SignedDistance& of_a_in_b, const Pose& b_in_a);

}  // namespace octoblisk::detail
