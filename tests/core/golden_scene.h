// What the golden hashes are of: shapes and poses by additions, products and square roots alone, which every
// compiler and processor rounds alike, and a hash of whatever the library answers.
#pragma once

#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"
#include "shared/meshes.h"

namespace octoblisk::testing {

/// The faces of a cube, each divided into segments², its vertices at 1 from the origin and moved from there
/// by as much as `bump`: closed, outward.
SharedMesh bumpyBall(std::mt19937_64& random, double radius, double bump, int segments);

/// A uniform rotation, and a translation of the given length.
Pose poseAt(std::mt19937_64& random, double distance);

/// Collects answers, of which the hash is that of all bits.
class Answers {
 public:
  void add(double number);
  void add(std::uint64_t number) { add(std::as_bytes(std::span(&number, 1))); }
  void add(std::span<const std::byte> more) { bytes_.insert(bytes_.end(), more.begin(), more.end()); }
  void add(const Vec3& point) {
    for (int k = 0; k < 3; ++k) add(point[k]);
  }
  std::uint64_t hash() const;

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace octoblisk::testing
