// The triangles of a leaf that may be near a body. Included once for each target (simd-inl.h).
#if defined(OCTOBLISK_QUERY_LEAF_TRIANGLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_QUERY_LEAF_TRIANGLES_INL_H
#undef OCTOBLISK_QUERY_LEAF_TRIANGLES_INL_H
#else
#define OCTOBLISK_QUERY_LEAF_TRIANGLES_INL_H
#endif

#include <cstdint>
#include <span>

#include "simd/lanes.h"
#include "tree/node_boxes-inl.h"
#include "tree/tree.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// Calls visit(triangle) for each triangle of a leaf that a cull lets through: cull.near(…, limit), as
/// PointCull, ConvexCull and MotionCull have it. Returns true as soon as a visit does, otherwise false.
template <typename Cull, typename Visit>
HWY_INLINE bool forEachNearInLeaf(const Tree& tree, Slot leaf, const Cull& cull, double limit,
                                  Visit&& visit) {
  const std::span<const std::uint32_t> triangles = tree.triangles(tree.child(leaf));
  Box8 box_room(Box8::Unset{});
  LeafVertices room;
  const BoxF box = boxesAt(tree, leaf, box_room).get(leaf.lane);
  const float* const rows = tree.leafVertices(leaf, room);
  for (const std::uint32_t i : Lanes(cull.near(box, rows, tree.child(leaf).count(), limit))) {
    if (visit(triangles[i])) return true;
  }
  return false;
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
