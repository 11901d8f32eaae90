// What a walk down the trees needs beside them: poses and boxes in their frames, and its to-do list.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>

#include "octoblisk/rounding.h"

namespace octoblisk {

/// Beyond it lie only the empty boxes of a node: a reach is cut off here, so that they are never entered.
inline constexpr double kFarthest = 1e29;

/// The gap up to which boxes of bodies of this summed size may be within `reach` of each other.
inline float traversalLimit(double reach, double size) {
  return static_cast<float>(std::min(kFarthest, reach + kSingleRounding * (size + reach)));
}

/// The pose of tree B in tree A, between the frames that their boxes are in.
struct LocalPose {
  Pose exact;  ///< of B in A
  PoseF b_to_a, a_to_b;
  double size;     ///< of both trees and the way between them, which sets the rounding in single precision
  double doubles;  ///< how far posed vertices may be off in double precision, of bodies far from an origin

  LocalPose(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a)
      : exact{b_in_a.rotation, b_in_a * b.origin() - a.origin()},
        b_to_a(exact),
        a_to_b(exact.inverse()),
        size(exact.translation.norm() + a.radius() + b.radius()),
        doubles(kDoubleRounding *
                (size + a.origin().norm() + b.origin().norm() + b_in_a.translation.norm())) {}

  float limit(double reach) const { return traversalLimit(reach + doubles, size); }
};

/// A box in a tree's local frame, and the size of tree, box and the way between them.
struct LocalBox {
  BoxF box;
  double size;

  LocalBox(const ClusteredOctree& tree, const Obb& box_in_tree) {
    const Vec3 center = box_in_tree.center - tree.origin();
    box = {center.cast<float>(), inSinglePrecision(box_in_tree.axes), box_in_tree.half_extents.cast<float>()};
    size = center.norm() + tree.radius() + box_in_tree.half_extents.norm();
  }
};

/// Puts the last of so many entries where it belongs among those since `first`, which are by descending gap.
template <typename Entry>
void sinkLast(Entry* entries, std::size_t first, std::size_t count) {
  const Entry entry = entries[count - 1];
  std::size_t place = count - 1;
  for (; place > first && entries[place - 1].gap < entry.gap; --place) entries[place] = entries[place - 1];
  entries[place] = entry;
}

/// The walk's to-do list. It begins with at most eight times eight entries; then one is taken and at most
/// eight are put for it, and each has a box less above its leaves: this never overflows.
template <typename Entry, int kLevels>
class TraversalStack {
 public:
  bool empty() const { return count_ == 0; }
  const Entry& pop() { return entries_[--count_]; }

  /// Puts an entry so that those since `first` come out by ascending gap.
  void pushSorted(std::size_t first, const Entry& entry) {
    assert(count_ < entries_.size());
    entries_[count_++] = entry;
    sinkLast(entries_.data(), first, count_);
  }
  std::size_t size() const { return count_; }

  /// What was popped last is too far: nothing follows from that for those that wait.
  void dismiss() {}
  /// Nor from what it looked at.
  void sawLeaves(float) {}

 private:
  std::array<Entry, (kLanes - 1) * kLevels + kLanes * kLanes> entries_;
  std::size_t count_ = 0;
};

}  // namespace octoblisk
