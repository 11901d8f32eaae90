// The boxes of a tree's nodes as the queries read them: used in place in a full tree, decoded in a compact
// one. Included once for each target (simd-inl.h).
#if defined(OCTOBLISK_TREE_NODE_BOXES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_TREE_NODE_BOXES_INL_H
#undef OCTOBLISK_TREE_NODE_BOXES_INL_H
#else
#define OCTOBLISK_TREE_NODE_BOXES_INL_H
#endif

#include "simd/simd-inl.h"
#include "tree/tree.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// The axes that a quaternion represents, for one quaternion or eight.
template <typename Real>
HWY_INLINE void axesOf(const Real (&q)[4], Real (&axes)[3][3]) {
  const Real xx = q[0] * q[0], yy = q[1] * q[1], zz = q[2] * q[2], one(1.0f);
  const Real scale = Real(2.0f) / (xx + yy + zz + q[3] * q[3]);
  const Real xy = q[0] * q[1], yz = q[1] * q[2], zx = q[2] * q[0];
  const Real xw = q[0] * q[3], yw = q[1] * q[3], zw = q[2] * q[3];
  axes[0][0] = one - scale * (yy + zz);
  axes[0][1] = scale * (xy - zw);
  axes[0][2] = scale * (zx + yw);
  axes[1][0] = scale * (xy + zw);
  axes[1][1] = one - scale * (zz + xx);
  axes[1][2] = scale * (yz - xw);
  axes[2][0] = scale * (zx - yw);
  axes[2][1] = scale * (yz + xw);
  axes[2][2] = one - scale * (xx + yy);
}

/// Writes one box of a compact node into its lane.
inline HWY_NOINLINE void decode(const CompactNode& node, std::uint32_t lane, Box8& boxes) {
  float q[4], axes[3][3];
  for (int k = 0; k < 4; ++k) q[k] = node.rotation[k][lane];
  axesOf(q, axes);
  for (int k = 0; k < 3; ++k) {
    const float half_extent = node.half_extents[k][lane];
    boxes.center[k][lane] = node.origin[k] + node.scale * static_cast<float>(node.center[k][lane]);
    boxes.half_extents[k][lane] = half_extent < 0.5f ? Box8::kEmptyHalfExtent : node.scale * half_extent;
    for (int j = 0; j < 3; ++j) boxes.axes[k][j][lane] = axes[k][j];
  }
}

/// Writes all boxes of a compact node.
inline HWY_NOINLINE void decode(const CompactNode& node, Box8& boxes) {
  Float8 q[4], axes[3][3];
  for (int k = 0; k < 4; ++k) q[k] = Float8::load(node.rotation[k]);
  axesOf(q, axes);
  const Float8 scale(node.scale), empty(Box8::kEmptyHalfExtent);
  for (int k = 0; k < 3; ++k) {
    const Float8 half_extent = Float8::load(node.half_extents[k]);
    (Float8(node.origin[k]) + scale * Float8::load(node.center[k])).store(boxes.center[k]);
    select(half_extent, Float8(0.5f), empty, scale * half_extent).store(boxes.half_extents[k]);
    for (int j = 0; j < 3; ++j) axes[k][j].store(boxes.axes[k][j]);
  }
}

/// The boxes of a node. `room` is a buffer for those of a compact tree.
HWY_INLINE const Box8& boxesOf(const Tree& tree, std::uint32_t node, Box8& room) {
  if (HWY_LIKELY(!tree.isCompact())) return tree.nodes()[node].boxes;
  decode(tree.compactNodes()[node], room);
  return room;
}

/// The same, but only the slot's lane may be read.
HWY_INLINE const Box8& boxesAt(const Tree& tree, Slot slot, Box8& room) {
  if (HWY_LIKELY(!tree.isCompact())) return tree.nodes()[slot.node].boxes;
  decode(tree.compactNodes()[slot.node], slot.lane, room);
  return room;
}

/// The largest half extent of a box, which must not be empty.
HWY_INLINE float largestHalfExtent(const Tree& tree, Slot slot) {
  if (HWY_LIKELY(!tree.isCompact())) return tree.nodes()[slot.node].boxes.largestHalfExtent(slot.lane);
  const CompactNode& node = tree.compactNodes()[slot.node];
  return node.scale * static_cast<float>(node.half_extents[0][slot.lane]);
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
