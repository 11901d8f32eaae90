// Random poses of hard meshes, pairs held to exact arithmetic and distances to those of all pairs: soaked for
// long by bench/pose_soak, for a moment by the tests.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shared/hard_meshes.h"

namespace octoblisk::testing {

/// What two meshes the poses of a scene are of: all by its number.
struct SoakScene {
  MeshKind a, b;
  double scale;      ///< of A, in mesh units: 1e-6 to 1e6
  double ratio;      ///< of B to A: 1e-3 to 1
  double far;        ///< how far A lies from the origin, in its own size: 0 to 1e6
  const char* tree;  ///< how the trees are made
};
SoakScene soakScene(std::uint64_t number);

struct SoakTally {
  std::uint64_t poses = 0, hits = 0;                 ///< hits, by the oracle
  std::uint64_t pairs = 0;                           ///< of triangles that meet, by the oracle
  std::uint64_t missed = 0;                          ///< verdicts and pairs that the library does not give
  std::uint64_t wrong = 0;                           ///< those that it gives and the oracle does not
  std::uint64_t distances = 0, wrong_distances = 0;  ///< of some of the poses that are clear
  std::vector<std::string> findings;                 ///< a line for each of the first that differ

  SoakTally& operator+=(const SoakTally& more);
  bool agrees() const { return missed == 0 && wrong == 0 && wrong_distances == 0; }
};

/// Asks `collide` and `touchingPairs` at so many poses of a scene, and `distance` at some. Oracles: CGAL's
/// exact predicates on every pair of triangles whose bounds meet; of distances, every pair of triangles.
SoakTally soak(std::uint64_t scene_number, int poses);

}  // namespace octoblisk::testing
