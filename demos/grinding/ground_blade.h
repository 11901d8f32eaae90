// Finds the blade that a path grinds.
#pragma once

#include <optional>
#include <span>

#include "grinding/run_watch.h"
#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

/// The blade that the belt touches at most poses of a path; the lowest of several, 0 if it touches none;
/// nothing if the watch stopped the search. The answer does not depend on the number of threads.
std::optional<int> bladeTouchedMost(const ClusteredOctree& blisk, const ClusteredOctree& belt,
                                    std::span<const int> blade_of_triangle, std::span<const Pose> path,
                                    int threads = 0, const RunWatch& watch = {});

}  // namespace octoblisk::demos
