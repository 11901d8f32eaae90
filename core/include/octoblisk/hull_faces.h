// The faces and edges of the hull of a few points, from which separating axes are made.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk {

/// The hull is on the side where normal · x <= offset.
struct HullFace {
  Vec3 normal;  ///< unit
  double offset;
};

struct HullEdge {
  std::uint32_t from, to;     ///< the points that it joins
  std::uint32_t left, right;  ///< the faces on either side
  double cosine;              ///< of the angle between the faces' normals
};

/// A view of faces and edges.
struct HullFaces {
  std::span<const HullFace> faces;
  std::span<const HullEdge> edges;

  bool empty() const { return faces.empty(); }
};

/// Owns faces and edges. Coplanar triangles make one face. Every face is moved out to the farthest of the
/// points.
class HullFaceList {
 public:
  static constexpr std::size_t kMaxPoints = 64;

  /// Finds no faces if the points' hull has no volume, if there are more than kMaxPoints points, or if
  /// rounding makes the hull too hard to find; searches then work without them. Allocates nothing once its
  /// buffers are large enough.
  void find(std::span<const Vec3> points);

  HullFaces view() const { return {faces_, edges_}; }

 private:
  std::vector<HullFace> faces_;
  std::vector<HullEdge> edges_;
};

}  // namespace octoblisk
