// The planes that bound a mesh in many directions.
#pragma once

#include <cstddef>
#include <vector>

#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

/// Planes that touch a mesh from outside, with normals spread over all directions, at most 0.045 rad from
/// any. Immutable.
class SupportPlanes {
 public:
  explicit SupportPlanes(const ClusteredOctree& tree, int threads = 0);

  /// The plane whose normal is among the nearest to a direction, which must not be zero.
  std::size_t facing(const Vec3& direction) const;

  /// The height of a point above a plane. If positive, the point is outside the mesh, at least this far away.
  double heightAbove(std::size_t plane, const Vec3& point) const {
    return planes_[plane].normal.dot(point) - planes_[plane].offset;
  }

 private:
  struct Plane {
    Vec3 normal;
    double offset;
  };
  std::vector<Plane> planes_;  // a grid on each side of a cube: +x, -x, +y, …
};

}  // namespace octoblisk::demos
