// The descent of a ray through a tree, boxes and triangles eight at a time. It does not use traversal-inl.h,
// because it continues to the nearest child without the to-do list and prefetches the others. Included once
// for each target (simd-inl.h).
#ifndef OCTOBLISK_QUERY_RAY_WALK_ONCE
#define OCTOBLISK_QUERY_RAY_WALK_ONCE

#include <array>
#include <bit>
#include <cstdint>

#include "query/local_ray.h"
#include "query/ray_walk.h"
#include "query/tally.h"

namespace octoblisk::detail {

/// A child that a ray has yet to visit, and the reach at which the ray enters it. Tasks are ordered by reach.
/// Reaches are above 0, so the order of their bits is that of their values.
class RayTask {
 public:
  RayTask() {}  // NOLINT(modernize-use-equals-default): {} must not initialise it: there are many of them
  RayTask(float reach, Slot slot)
      : bits_(std::uint64_t{std::bit_cast<std::uint32_t>(reach)} << 32 | std::uint64_t{slot.node} << 3 |
              slot.lane) {}
  float reach() const { return std::bit_cast<float>(static_cast<std::uint32_t>(bits_ >> 32)); }
  Slot slot() const {
    const auto low = static_cast<std::uint32_t>(bits_);
    return {low >> 3, low & 7u};
  }
  bool operator<(const RayTask& other) const { return bits_ < other.bits_; }

 private:
  std::uint64_t bits_;
};

}  // namespace octoblisk::detail
#endif

#if defined(OCTOBLISK_QUERY_RAY_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_QUERY_RAY_WALK_INL_H
#undef OCTOBLISK_QUERY_RAY_WALK_INL_H
#else
#define OCTOBLISK_QUERY_RAY_WALK_INL_H
#endif

#include <hwy/cache_control.h>

#include "query/ray_lanes-inl.h"
#include "simd/lanes.h"
#include "tree/node_boxes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// Calls `visit` for the triangles that a ray may cross, entering boxes by ascending t. `visit` tests the
/// triangle exactly and returns the greatest t still of interest, or a negative number to stop. The tally
/// counts the tests (tally.h).
template <typename Visit, typename Tally>
class RayDescent {
 public:
  RayDescent(const Tree& tree, const LocalRay& local, Visit visit, Tally& tally)
      : tree_(tree), local_(local), visit_(visit), tally_(tally), limit_(local.length) {}

  void run() {
    while (step()) {
    }
  }

  /// Enters a node or visits a leaf. Returns false if it was the last one.
  HWY_INLINE bool step() {
    if (tree_.child(here_).isLeaf()) {
      if (!visitLeaf(here_)) return false;
    } else if (enterNode(here_)) {
      return true;
    }
    do {
      if (count_ == 0) return false;
      --count_;
    } while (tasks_[count_].reach() > limit_);
    here_ = tasks_[count_].slot();
    return true;
  }

  /// Prefetches the data of the next step.
  HWY_INLINE void prefetchNext() const {
    const Child child = tree_.child(here_);
    if (!child.isLeaf()) {
      prefetch(here_);
    } else if (!tree_.isCompact()) {
      LeafVertices unused;
      const std::span<const std::uint32_t> triangles = tree_.triangles(child);
      fetch(tree_.leafVertices(here_, unused), 9 * triangles.size());
      fetch(triangles.data(), triangles.size());
    }
  }

 private:
  /// Adds the entered children to the list, except for the nearest, which is assigned to `here`. Returns
  /// false if there is none.
  HWY_INLINE bool enterNode(Slot& here) {
    const std::uint32_t index = tree_.child(here).node();
    tally_.boxTest();
    Box8 room(Box8::Unset{});
    HWY_ALIGN float reaches[kLanes];
    unsigned entered = enter(boxesOf(tree_, index, room), local_, limit_, reaches);
    if (entered == 0) return false;
    if ((entered & (entered - 1)) == 0) {
      here = {index, static_cast<std::uint32_t>(std::countr_zero(entered))};
      return true;
    }
    const auto take = [&](unsigned& lanes) HWY_ATTR {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
      lanes &= lanes - 1;
      return RayTask(reaches[lane], {index, lane});
    };
    RayTask nearest = take(entered);
    const std::size_t first = count_;
    while (entered != 0) {
      RayTask task = take(entered);
      if (task < nearest) std::swap(task, nearest);
      prefetch(task.slot());
      std::size_t place = count_++;
      for (; place > first && tasks_[place - 1] < task; --place) tasks_[place] = tasks_[place - 1];
      tasks_[place] = task;
    }
    here = nearest.slot();
    return true;
  }

  /// The ray usually does not end in the nearest child, so the next ones are loaded ahead.
  HWY_INLINE void prefetch(Slot slot) const {
    const Child child = tree_.child(slot);
    if (child.isLeaf()) return;
    if (tree_.isCompact()) {
      fetch(&tree_.compactNodes()[child.node()], 1);
    } else {
      fetch(&tree_.nodes()[child.node()], 1);
    }
  }

  template <typename Element>
  static HWY_INLINE void fetch(const Element* elements, std::size_t count) {
    constexpr std::size_t kLine = 64;
    const auto* bytes = reinterpret_cast<const char*>(elements);
    for (std::size_t i = 0; i < count * sizeof(Element); i += kLine) hwy::Prefetch(bytes + i);
  }

  /// The exact tests read through two indirections; the test in single precision can hide their latency. For
  /// a compact tree, that test reads the same data itself.
  HWY_INLINE void prefetchExact(std::span<const std::uint32_t> triangles) const {
    const TriangleMesh& mesh = tree_.mesh();
    for (const std::uint32_t triangle : triangles) {
      for (const std::uint32_t corner : mesh.triangles()[triangle]) hwy::Prefetch(&mesh.vertices()[corner]);
    }
  }

  /// Returns false if nothing more is of interest.
  HWY_INLINE bool visitLeaf(Slot slot) {
    tally_.leafPair();
    tally_.triangleTest();
    const Child leaf = tree_.child(slot);
    Box8 room(Box8::Unset{});
    LeafVertices corners;
    const ShearedRay sheared(local_, boxesAt(tree_, slot, room), slot.lane);
    const std::span<const std::uint32_t> triangles = tree_.triangles(leaf);
    if (!tree_.isCompact()) prefetchExact(triangles);
    const unsigned in_leaf = (1u << triangles.size()) - 1;
    const unsigned crossed =
        mayCross(tree_.leafVertices(slot, corners), triangles.size(), sheared, limit_) & in_leaf;
    for (const std::uint32_t i : Lanes(crossed)) {
      tally_.exactTest();
      const double wanted = visit_(triangles[i]);
      if (wanted < 0.0) return false;
      limit_ = std::min(limit_, local_.reachOf(wanted));
    }
    return true;
  }

  const Tree& tree_;
  const LocalRay local_;
  const Visit visit_;
  Tally& tally_;
  float limit_;  // the reach still of interest
  Slot here_ = Tree::kRoot;
  std::size_t count_ = 0;
  std::array<RayTask, (kLanes - 1) * Tree::kMaxDepth> tasks_;
};

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
