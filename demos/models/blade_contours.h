// Lines around a blade at equal heights: its sections.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "models/blade_sides.h"

namespace octoblisk::demos {

/// A point on a triangle of a blade.
struct ContourPoint {
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< of length 1, out of the blade, smooth over the triangles of its sides
};

/// The line around a blade at one height, cut at its least z, the leading edge, and at its greatest z, the
/// trailing edge. Both halves run from the leading to the trailing edge and include both points.
struct BladeContour {
  std::vector<ContourPoint> forward, backward;
};

/// Heights over the sides of one blade: 0 along its root, 1 along its tip or at the shroud, and harmonic
/// between them (their Laplacian is 0, with cotangent weights), so they rise smoothly whatever the shape of
/// hub and tip. If a blade passes through the hub, its root is where its triangles end.
class BladeContours {
 public:
  /// For the blade with that number in `sides`. The blisk's axis is Z. Throws std::invalid_argument with a
  /// one-line message if the blade's sides do not end in a root and a tip.
  BladeContours(const TriangleMesh& blisk, const BladeSides& sides, int blade);

  /// The contour at a height from 0 to 1. Between two of its points it is straight and on one triangle.
  /// Throws std::invalid_argument if the contour is not closed.
  BladeContour at(double height) const;

 private:
  using Corners = std::array<std::uint32_t, 3>;

  void addTriangles(const TriangleMesh& blisk, const BladeSides& sides);
  void linkTriangles();
  void solveHeights();
  bool crosses(std::uint32_t from, std::uint32_t to, double height) const {
    return (heights_[from] < height) != (heights_[to] < height);
  }
  std::vector<ContourPoint> loopFrom(std::uint32_t triangle, double height, std::vector<bool>& seen) const;

  static constexpr std::uint32_t kNone = 0xffffffff;

  int blade_;
  std::vector<Vec3> positions_, normals_;  // one per place, however often the mesh repeats it
  std::vector<Corners> triangles_;
  std::vector<Corners> beside_;  // the triangle across the edge from each corner to the next, or kNone
  std::vector<double> heights_;  // per position
};

}  // namespace octoblisk::demos
