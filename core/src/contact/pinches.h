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
  /// `meeting` holds all pairs that meet. At each crossing, the candidates are the contacts that push across
  /// or against the way out of the intersection (wayOut) and whose triangles do not face each other. If a
  /// contact pushes out, removes only the candidates that another contact opposes; otherwise removes all
  /// candidates. The deepest of the removed contacts comes back, but pushes out, at the middle of the curve
  /// in which the surfaces meet. Its depth is the extent of this curve along the way out. If no other contact
  /// pushes out, the depth is at least that of its triangles.
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
