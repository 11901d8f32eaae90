// Queries of many poses or rays at once, on several threads.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "octoblisk/collide.h"
#include "octoblisk/distance.h"
#include "octoblisk/raycast.h"
#include "octoblisk/signed_distance.h"

namespace octoblisk {

/// collideAll, distanceAll and signedDistanceAll give each PathQuery this many consecutive poses. The next
/// query starts afresh, so answers do not depend on how the poses are shared among threads.
inline constexpr std::size_t kPosesAtOnce = 64;

/// For each pose, a pair of triangles that meet, or none. Uses at most `threads` threads; 0 or less uses as
/// many as the machine runs at once. Fastest if neighbouring poses in the list are near each other. The
/// result is the same to the last bit for any number of threads. Throws std::bad_alloc if memory runs out.
std::vector<std::optional<TrianglePair>> collideAll(const ClusteredOctree& a, const ClusteredOctree& b,
                                                    std::span<const Pose> poses_of_b_in_a, int threads = 0);

/// For each pose, the least distance under the same options. Otherwise like collideAll.
std::vector<Clearance> distanceAll(const ClusteredOctree& a, const ClusteredOctree& b,
                                   std::span<const Pose> poses_of_b_in_a, const DistanceOptions& options = {},
                                   int threads = 0);

/// For each pose, the signed distance. Otherwise like collideAll. Throws std::invalid_argument if there
/// are poses and neither surface is closed.
std::vector<SignedDistance> signedDistanceAll(const Surface& a, const Surface& b,
                                              std::span<const Pose> poses_of_b_in_a,
                                              const SignedDistanceOptions& options = {}, int threads = 0);

/// For each ray, what closestHit returns. Faster than one ray at a time, whatever their order: while one ray
/// waits for memory, others go on. Otherwise like collideAll.
std::vector<std::optional<RayHit>> closestHitAll(const ClusteredOctree& tree, std::span<const Ray> rays,
                                                 int threads = 0);

}  // namespace octoblisk
