// Where the vertices of a mesh are at a pose.
#pragma once

#include <algorithm>
#include <limits>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::testing {

/// The least z of a vertex at the pose.
inline double lowestZ(const TriangleMesh& mesh, const Pose& pose) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& vertex : mesh.vertices()) lowest = std::min(lowest, (pose * vertex).z());
  return lowest;
}

/// The greatest distance between a vertex's positions at two poses.
inline double greatestDisplacement(const TriangleMesh& mesh, const Pose& from, const Pose& to) {
  double greatest = 0.0;
  for (const Vec3& vertex : mesh.vertices())
    greatest = std::max(greatest, (from * vertex - to * vertex).norm());
  return greatest;
}

}  // namespace octoblisk::testing
