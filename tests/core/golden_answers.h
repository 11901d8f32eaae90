// The hashes of every kind of tree and answer for one scene.
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

/// Two balls and a triangle soup that the balls meet in about half of the poses.
struct GoldenScene {
  SharedMesh ball, knob, soup;
  std::vector<Pose> poses;

  GoldenScene();
};

/// The hashes and the number of hits. Hashes of misses alone would prove little.
struct GoldenAnswers {
  std::vector<Golden> hashes;
  std::size_t hits = 0;     ///< of the balls
  double share_near = 0.0;  ///< of clustersNear
};

GoldenAnswers goldenAnswers(const GoldenScene& scene, int threads);

}  // namespace octoblisk::testing
