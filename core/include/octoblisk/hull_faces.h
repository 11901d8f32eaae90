// The faces and edges of the hull of a few points: what separating axes are made of.
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
  std::uint32_t left, right;  ///< the faces that meet in it
  double cosine;              ///< of the angle between their normals
};

/// A view of them.
struct HullFaces {
  std::span<const HullFace> faces;
  std::span<const HullEdge> edges;

  bool empty() const { return faces.empty(); }
};

/// Owns them. Triangles in one plane make one face; every face is moved out to the farthest of the points.
class HullFaceList {
 public:
  static constexpr std::size_t kMostPoints = 64;

  /// None for points that have no hull with a volume, of which there are too many, or that rounding makes
  /// too hard: searches do without. Allocates nothing once it has had the room.
  void find(std::span<const Vec3> points);

  HullFaces view() const { return {faces_, edges_}; }

 private:
  std::vector<HullFace> faces_;
  std::vector<HullEdge> edges_;
};

}  // namespace octoblisk
