// Random poses of hard meshes. Compares triangle pairs with exact arithmetic, and distances with those of all
// pairs. bench/pose_soak runs it for long, the tests only briefly.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shared/hard_meshes.h"

namespace octoblisk::testing {

/// The two meshes of a scene. The scene's number determines everything.
struct SoakScene {
  MeshKind a, b;
  double scale;      ///< of A, in mesh units: 1e-6 to 1e6
  double ratio;      ///< of B to A: 1e-3 to 1
  double far;        ///< distance of A from the origin, in sizes of A: 0 to 1e6
  const char* tree;  ///< how the trees are made
};
SoakScene soakScene(std::uint64_t number);

struct SoakTally {
  std::uint64_t poses = 0, hits = 0;                 ///< hits, by the oracle
  std::uint64_t pairs = 0;                           ///< triangle pairs that meet, by the oracle
  std::uint64_t missed = 0;                          ///< verdicts and pairs that the library misses
  std::uint64_t wrong = 0;                           ///< verdicts and pairs that only the library reports
  std::uint64_t distances = 0, wrong_distances = 0;  ///< at some of the clear poses
  std::vector<std::string> findings;                 ///< one line for each of the first differences

  SoakTally& operator+=(const SoakTally& more);
  bool agrees() const { return missed == 0 && wrong == 0 && wrong_distances == 0; }
};

/// Runs `collide` and `touchingPairs` at `poses` poses of a scene, and `distance` at some. The oracles are
/// CGAL's exact predicates on every triangle pair whose bounds meet and, for distances, every triangle pair.
SoakTally soak(std::uint64_t scene_number, int poses);

}  // namespace octoblisk::testing
