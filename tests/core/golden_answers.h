// The hash of every kind of tree and answer of one scene.
#pragma once

#include <cstdint>
#include <vector>

#include "octoblisk/types.h"
#include "shared/meshes.h"

namespace octoblisk::testing {

struct Golden {
  const char* of;
  std::uint64_t hash;
};

/// Two balls and a soup, which the balls meet in about half of the poses.
struct GoldenScene {
  SharedMesh ball, knob, soup;
  std::vector<Pose> poses;

  GoldenScene();
};

/// Hashes of misses alone would say little: how many of the poses are hits is told too.
struct GoldenAnswers {
  std::vector<Golden> hashes;
  std::size_t hits = 0;     ///< of the balls
  double share_near = 0.0;  ///< of clustersNear
};

GoldenAnswers goldenAnswers(const GoldenScene& scene, int threads);

}  // namespace octoblisk::testing
