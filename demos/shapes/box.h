// A box of twelve triangles.
#pragma once

#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::shapes {

/// Closed, facing outward.
inline TriangleMesh box(const Vec3& low, const Vec3& high) {
  std::vector<Vec3> vertices;
  for (int corner = 0; corner < 8; ++corner) {
    vertices.emplace_back(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                          corner & 4 ? high.z() : low.z());
  }
  return TriangleMesh(std::move(vertices), {{0, 2, 3},
                                            {0, 3, 1},
                                            {4, 5, 7},
                                            {4, 7, 6},
                                            {0, 1, 5},
                                            {0, 5, 4},
                                            {2, 6, 7},
                                            {2, 7, 3},
                                            {0, 4, 6},
                                            {0, 6, 2},
                                            {1, 3, 7},
                                            {1, 7, 5}});
}

}  // namespace octoblisk::shapes
