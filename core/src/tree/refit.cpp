#include "tree/refit.h"

#include <algorithm>
#include <limits>

#include "base/parallel.h"
#include "tree/box_padding.h"
#include "tree/for_each_node.h"
#include "tree/leaf_vertices.h"
#include "tree/tree_vertices.h"

namespace octoblisk::detail {
namespace {

/// The ranges of triangles below the boxes of a tree.
class Ranges {
 public:
  explicit Ranges(const TreeArrays& tree) : of_node_(tree.nodeCount()) {
    for (auto n = static_cast<std::uint32_t>(tree.nodeCount()); n-- > 0;) {  // children come after parents
      TriangleRange all{std::numeric_limits<std::uint32_t>::max(), 0};
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        const Child child = tree.child({n, lane});
        if (child.isEmpty()) continue;
        const TriangleRange range = of(child);
        all = {std::min(all.begin, range.begin), std::max(all.end, range.end)};
      }
      of_node_[n] = all;
    }
  }

  TriangleRange of(Child child) const {
    return child.isLeaf() ? TriangleRange{child.first(), child.first() + child.count()}
                          : of_node_[child.node()];
  }

 private:
  std::vector<TriangleRange> of_node_;
};

/// The bounds of the vertices in the frames of all boxes. The bounds of large boxes are computed first, in
/// pieces, so that all threads have work.
class Extents {
 public:
  Extents(const TreeArrays& tree, const Ranges& ranges, const TreeVertices& vertices, int threads)
      : ranges_(ranges), vertices_(vertices) {
    struct Piece {
      std::size_t large;
      TriangleRange range;
      Extent extent;
    };
    std::vector<Piece> pieces;
    forEachChild(tree, [&](Slot slot, Child child) {
      const TriangleRange range = ranges.of(child);
      if (range.count() <= kLarge) return;
      for (std::uint32_t begin = range.begin; begin < range.end; begin += kLarge)
        pieces.push_back({large_.size(), {begin, std::min(range.end, begin + kLarge)}, {}});
      large_.push_back({slot, {}});
    });
    parallelFor(pieces.size(), threads, [&](std::size_t p, std::size_t) {
      const Slot slot = large_[pieces[p].large].slot;
      const Eigen::Vector3f from = vertices.first(ranges.of(tree.child(slot)).begin);
      pieces[p].extent = vertices.extent(pieces[p].range, tree.box(slot).axes, from);
    });
    for (const Piece& piece : pieces) large_[piece.large].extent.extend(piece.extent);
  }

  /// The box with the slot's own axes that contains everything below it.
  BoxF box(Slot slot, Child child, const Eigen::Matrix3f& axes) const {
    return ranges_.of(child).count() > kLarge ? box(child, axes, ofLarge(slot)) : box(child, axes);
  }
  /// The box with other axes.
  BoxF box(Child child, const Eigen::Matrix3f& axes) const {
    const TriangleRange range = ranges_.of(child);
    return box(child, axes, vertices_.extent(range, axes, vertices_.first(range.begin)));
  }

 private:
  static constexpr std::uint32_t kLarge = 8192;  // triangles

  struct Large {
    Slot slot;
    Extent extent;
  };

  BoxF box(Child child, const Eigen::Matrix3f& axes, const Extent& extent) const {
    const Eigen::Vector3f middle = 0.5f * (extent.low + extent.high);
    return {vertices_.first(ranges_.of(child).begin) + axes * middle, axes,
            0.5f * (extent.high - extent.low)};
  }

  const Extent& ofLarge(Slot slot) const {
    const auto key = [](const Slot& s) { return std::pair(s.node, s.lane); };
    return std::ranges::lower_bound(large_, key(slot), {}, [&](const Large& l) { return key(l.slot); })
        ->extent;
  }

  const Ranges& ranges_;
  const TreeVertices& vertices_;
  std::vector<Large> large_;  // in the order of their slots
};

void fit(TreeNode& node, std::uint32_t index, const Extents& extents, float pad) {
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const Child child = node.children[lane];
    if (child.isEmpty()) continue;
    BoxF box = extents.box({index, lane}, child, node.boxes.get(lane).axes);
    box.half_extents.array() += pad;
    node.boxes.set(lane, box);
  }
}

/// The axes in descending order of half extents.
Eigen::Matrix3f sortedAxes(const BoxF& box) {
  Box8 boxes;
  boxes.set(0, box);
  return boxes.get(0).axes;
}

void fit(CompactNode& node, std::uint32_t index, const Extents& extents, float pad) {
  std::array<CompactRotation, kLanes> rotations = {};
  std::array<BoxF, kLanes> boxes;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const Child child = node.children[lane];
    if (child.isEmpty()) continue;
    rotations[lane] = node.rotationOf(lane);
    boxes[lane] = extents.box({index, lane}, child, decoded(rotations[lane]));
    const Eigen::Vector3f& half = boxes[lane].half_extents;
    if (half[0] >= half[1] && half[1] >= half[2]) continue;
    rotations[lane] = compactRotation(sortedAxes(boxes[lane]));
    boxes[lane] = extents.box(child, decoded(rotations[lane]));
  }
  node.setBoxes(rotations, boxes, pad);
}

}  // namespace

void refit(OwnedArrays& tree, const TriangleMesh& mesh, int threads) {
  const TreeVertices vertices(mesh, tree.triangle_order, mesh.bounds().center(), threads);
  const TreeArrays arrays = tree.view();
  const Ranges ranges(arrays);
  const Extents extents(arrays, ranges, vertices, threads);
  const float pad = boxPadding(mesh.bounds().halfExtents().norm());
  forEachNode(arrays, threads, [&](std::uint32_t n) {
    if (arrays.isCompact()) {
      fit(tree.compact_nodes[n], n, extents, pad);
    } else {
      fit(tree.nodes[n], n, extents, pad);
    }
  });
  if (!arrays.isCompact()) writeAllLeafVertices(tree, mesh, threads);
}

}  // namespace octoblisk::detail
