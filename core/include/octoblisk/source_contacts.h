// All contacts between a tree and the triangles of a TriangleSource.
#pragma once

#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"
#include "octoblisk/triangle_source.h"

namespace octoblisk {

namespace detail {
class Child;
struct Slot;
}  // namespace detail

/// Descends the tree. Asks the source for the triangles in a cluster's box as soon as the box holds few of
/// them. On the way to the leaves, drops those that are not near the smaller boxes. Keeps its buffers and
/// allocates nothing once warm: use one for each pair of bodies.
class SourceContacts {
 public:
  /// Replaces `found` with the contact of every triangle of the tree (A) with every triangle of the source
  /// (B) no farther apart than `threshold` (>= 0, mesh units). Each pair occurs once; pairs are in ascending
  /// order of indices. Points and normals are in A's frame. Contact::triangle_b is an argument for
  /// triangle(). A triangle of the source that is not finite touches nothing.
  void find(const ClusteredOctree& a, const TriangleSource& b, const Pose& b_in_a, double threshold,
            std::vector<Contact>& found);

  /// The source's triangle of a contact that the last find() returned, in the source's frame. The numbers
  /// ascend by part, index and corners.
  const SourceTriangle& triangle(std::uint32_t triangle_b) const { return touched_[triangle_b]; }

 private:
  class Query;
  /// A triangle of the source that may be near the current cluster.
  struct Candidate {
    SourceTriangle in_b;
    Triangle in_a;
  };
  /// What is known about a cluster: its candidates, if they were few; otherwise the number of levels below
  /// which they may be few.
  struct Nearby {
    bool listed = false;
    std::size_t begin = 0, end = 0;  // in near_
    int levels_to_skip = 0;
  };

  void descend(const Query& query, detail::Slot slot, const Nearby& above);
  Nearby nearbyOf(const Query& query, detail::Slot slot, const Nearby& above);
  void testLeaf(const Query& query, detail::Child leaf, const Nearby& nearby);
  void numberTouched(std::vector<Contact>& found);

  std::vector<Candidate> candidates_;
  std::vector<std::size_t> near_;  // indices of candidates_, stacked for the clusters on the current path
  std::vector<SourceTriangle> touched_;
  std::vector<std::uint32_t> order_, number_;  // of touched_
};

}  // namespace octoblisk
