// A coordinate measuring machine that probes a mesh with a ball.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

/// In mm; all assumed.
struct CmmOptions {
  double probe_radius = 0.5;  ///< of the ball
  double noise = 0.0005;      ///< standard deviation of a measured deviation
  double approach = 1.0;      ///< the ball moves from this far above a nominal point to this far below it
  std::uint64_t seed = 3;     ///< of the noise
};

struct NominalPoint {
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit, outwards
};

/// Moves the ball against the normal at each nominal point until it touches the part. The result is its
/// height above the position where it would touch the nominal surface: the deviation along the nominal
/// normal, with noise. As on a real machine, the ball may touch beside the point, so details smaller than the
/// ball are smoothed. The distance to the part is exact (closest_point.h); the ball stops within 1e-7 mm of
/// it.
///
/// Throws std::invalid_argument naming a point where the ball meets nothing or touches at the start; also for
/// options out of range.
std::vector<double> measureDeviations(const ClusteredOctree& part, std::span<const NominalPoint> points,
                                      const CmmOptions& options = {});

}  // namespace octoblisk::demos
