// The signed distance, once the least distance is known.
#pragma once

#include "octoblisk/depth.h"
#include "octoblisk/distance.h"
#include "octoblisk/signed_distance.h"

namespace octoblisk::detail {

/// The clearance is the least distance at this pose. `depth` keeps its memory for the next one.
SignedDistance signedDistance(const Surface& a, const Surface& b, const Pose& b_in_a,
                              const SignedDistanceOptions& options, const Clearance& clearance,
                              DepthQuery& depth);

}  // namespace octoblisk::detail
