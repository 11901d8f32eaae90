// Removes contacts that hold two crossing bodies in each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/connected_pairs.h"
#include "contact/surface_pair.h"
#include "geometry/intersection_curve.h"

namespace octoblisk::detail {

/// Contacts of triangles may hold two bodies in each other where their surfaces cross:
/// - Where two bars cross, the triangles at the sides are as deep as those at the top, and push in opposite
///   directions.
/// - The upper side of a thin body that is more than halfway in a floor is as near to the floor's triangles
/// as
///   the lower side, and pulls the body down.
class Pinches {
 public:
  /// `meeting` holds all pairs that meet. At each crossing, considers the contacts whose triangles do not
  /// face each other, and the way out of the intersection (wayOut). Removes
  /// - contacts that push against the way out, if the curve in which the surfaces meet is planar;
  /// - if both bodies are solids, contacts that push across or against the way out: those that another
  ///   contact opposes, or all if no contact pushes out. Surfaces that lie along each other, as the walls of
  ///   nested cups do, keep them.
  /// Unless the curve is planar and a contact pushes out, the deepest of these comes back, but pushes out, at
  /// the middle of the curve. Its depth is the extent of the curve along the way out. If no other contact
  /// pushes out, the depth is at least that of its triangles. The order stays. Allocates nothing once warm.
  void open(std::vector<PairedContact>& contacts, const SurfacePair& surfaces,
            const std::vector<NumberPair>& meeting, bool both_are_solid);

 private:
  using Members = std::span<const std::uint32_t>;

  void open(std::vector<PairedContact>& contacts, Members members, std::uint32_t group, bool both_are_solid);

  std::vector<CurveSegment> curve_;
  std::vector<NumberPair> of_segments_;  // the pairs per segment of the curve
  ConnectedPairs crossings_;             // pairs that meet
  std::vector<CurveSegment> crossing_;   // the part of the curve of one group
  std::vector<std::uint32_t> pinching_;  // contacts that may pinch
  std::vector<Vec3> pushing_;            // the normals of the contacts of one group
};

}  // namespace octoblisk::detail
