// Poses of the belt that test boxes for false alarms.
#pragma once

#include <cstdint>
#include <vector>

#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

/// A pose of the belt and its exact verdict on the triangles.
struct BeltPose {
  Pose belt_in_mesh;
  bool touches = false;
};

/// The exact verdicts on a path.
std::vector<BeltPose> judged(const ClusteredOctree& mesh, const ClusteredOctree& belt,
                             const std::vector<Pose>& path);

/// Seeded poses about a body: any rotation, and a random vertex of the belt within a cube of ±reach mm about
/// a random vertex of the body. The poses are the same, bit for bit, for the same seed.
std::vector<BeltPose> posesAbout(const ClusteredOctree& body, const ClusteredOctree& belt, std::size_t count,
                                 double reach, std::uint64_t seed);

}  // namespace octoblisk::demos
