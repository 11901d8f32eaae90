// Queries of many poses at once, on several threads.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "octoblisk/collide.h"
#include "octoblisk/distance.h"
#include "octoblisk/signed_distance.h"

namespace octoblisk {

/// Poses that one PathQuery goes through; the next begins afresh, so that no answer depends on which thread
/// had which poses.
inline constexpr std::size_t kPosesAtOnce = 64;

/// For each pose a pair of triangles that meet, or none, on up to so many threads; 0 or less: as many as the
/// machine runs at once. Fastest where neighbours in the list are near each other. The same bits for any
/// number of threads. Throws std::bad_alloc where memory runs out.
std::vector<std::optional<TrianglePair>> collideAll(const ClusteredOctree& a, const ClusteredOctree& b,
                                                    std::span<const Pose> poses_of_b_in_a, int threads = 0);

/// For each pose the least distance, with the same options; else as collideAll.
std::vector<Clearance> distanceAll(const ClusteredOctree& a, const ClusteredOctree& b,
                                   std::span<const Pose> poses_of_b_in_a, const DistanceOptions& options = {},
                                   int threads = 0);

/// For each pose the signed distance; else as collideAll. Throws std::invalid_argument where neither surface
/// is closed.
std::vector<SignedDistance> signedDistanceAll(const Surface& a, const Surface& b,
                                              std::span<const Pose> poses_of_b_in_a,
                                              const SignedDistanceOptions& options = {}, int threads = 0);

}  // namespace octoblisk
