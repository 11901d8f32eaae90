// Removes contacts that hold two crossing bodies in each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contact/connected_pairs.h"
#include "contact/surface_pair.h"
#include "geometry/intersection_curve.h"

namespace octoblisk::detail {

/// Contacts of triangles may hold two solids in each other where their surfaces cross:
/// - Where two bars cross, the triangles at the sides are as deep as those at the top, and push in opposite
///   directions.
/// - More than halfway in a floor, the upper side of a thin body is as near to the floor's triangles as its
///   lower side, and pulls the body down.
class Pinches {
 public:
  /// `meeting` holds all pairs that meet. Removes nothing if the curve in which the surfaces meet is not
  /// closed. At each crossing, considers the contacts whose triangles do not face each other, and the way out
  /// of the intersection (wayOut). Removes
  /// - contacts that push against the way out, if the curve of the crossing is planar;
  /// - contacts that push across or against the way out: those that another contact opposes, or all if no
  ///   contact pushes out. If the surfaces lie along each other, as the walls of nested cups do, these stay.
  /// Of the removed contacts, the deepest comes back, but pushes out, at the middle of the curve. Contacts
  /// of the first kind stay removed if another contact pushes out. The depth is the extent of the curve along
  /// the way out; if no other contact pushes out, it is at least that of the triangles. The order stays.
  /// Allocates nothing once warm.
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
  std::vector<Vec3> touching_;           // the normals of the contacts of one group that touch
};

}  // namespace octoblisk::detail
