// Opens the contacts of solids that cross each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/connected_pairs.h"
#include "contact/surface_pair.h"
#include "geometry/intersection_curve.h"

namespace octoblisk::detail {

/// Where two solids cross, like two bars, the triangles at the sides are as deep as those at the top, and
/// push in opposite directions. Such contacts hold the solids inside each other.
class Pinches {
 public:
  /// Receives all pairs that meet. At each crossing, considers the contacts that push across or against the
  /// way out of the intersection (wayOut), except those of triangles that face each other. If a contact
  /// pushes out, removes those that another contact opposes. Otherwise removes all. The deepest of them
  /// stays, but then pushes out, at the middle of the curve in which the surfaces meet. It is as deep as this
  /// curve extends on the way out; if no other contact pushes out, at least as deep as its triangles.
  /// Surfaces that lie along each other, as the walls of nested cups do, keep their contacts. The order
  /// stays. Allocates nothing once warm.
  void open(std::vector<PairedContact>& contacts, const SurfacePair& surfaces,
            const std::vector<NumberPair>& meeting);

 private:
  using Members = std::span<const std::uint32_t>;

  void open(std::vector<PairedContact>& contacts, Members members, std::uint32_t group);

  std::vector<CurveSegment> curve_;
  std::vector<NumberPair> of_segments_;  // the pairs per segment of the curve
  ConnectedPairs crossings_;             // pairs that meet
  std::vector<CurveSegment> crossing_;   // the part of the curve of one group
  std::vector<std::uint32_t> pinching_;  // contacts that may pinch
  std::vector<Vec3> pushing_;            // the normals of the contacts of one group
};

}  // namespace octoblisk::detail
