// The scene of the golden hashes. It makes shapes and poses only by additions, products and square roots,
// which every compiler and processor rounds alike. It also hashes the library's answers.
#pragma once

#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"
#include "shared/meshes.h"

namespace octoblisk::testing {

/// A cube whose faces are divided into segments² squares. Its vertices lie at `radius` from the origin, moved
/// by up to `bump`. Closed, outward.
SharedMesh bumpyBall(std::mt19937_64& random, double radius, double bump, int segments);

/// A uniform rotation, and a translation of the given length.
Pose poseAt(std::mt19937_64& random, double distance);

/// Collects answers. The hash covers all of their bits.
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
