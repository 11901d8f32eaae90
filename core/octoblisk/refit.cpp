#include "octoblisk/refit.h"

#include <algorithm>
#include <limits>

#include "octoblisk/leaf_vertices.h"
#include "octoblisk/parallel.h"
#include "octoblisk/tree_vertices.h"

namespace octoblisk {
namespace {

/// What is below the boxes of a tree.
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

/// The vertices' bounds in the frames of all boxes. Those of large boxes are taken beforehand, in pieces, so
/// that all threads have something to do.
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

  /// The box with the axes that holds all below a child; the slot's own axes where there is much below it.
  BoxF box(Slot slot, Child child, const Eigen::Matrix3f& axes) const {
    const TriangleRange range = ranges_.of(child);
    const Eigen::Vector3f from = vertices_.first(range.begin);
    const Extent extent = range.count() > kLarge ? ofLarge(slot) : vertices_.extent(range, axes, from);
    const Eigen::Vector3f middle = 0.5f * (extent.low + extent.high);
    return {from + axes * middle, axes, 0.5f * (extent.high - extent.low)};
  }

 private:
  static constexpr std::uint32_t kLarge = 8192;  // triangles

  struct Large {
    Slot slot;
    Extent extent;
  };

  const Extent& ofLarge(Slot slot) const {
    const auto key = [](const Slot& s) { return std::pair(s.node, s.lane); };
    return std::ranges::lower_bound(large_, key(slot), {}, [&](const Large& l) { return key(l.slot); })
        ->extent;
  }

  const Ranges& ranges_;
  const TreeVertices& vertices_;
  std::vector<Large> large_;  // in the order of their slots
};

}  // namespace

float boxPadding(double radius) {
  constexpr double kRounding = 0x1p-20;  // of the radius: sixteen units in the last place
  constexpr auto kSmallest = static_cast<double>(std::numeric_limits<float>::min());
  return static_cast<float>(kRounding * radius + kSmallest);
}

void refit(OwnedArrays& tree, const TriangleMesh& mesh, const Vec3& origin, double radius, int threads) {
  const TreeVertices vertices(mesh, tree.triangle_order, origin, threads);
  const Ranges ranges(tree.view());
  const Extents extents(tree.view(), ranges, vertices, threads);
  const float pad = boxPadding(radius);
  constexpr std::size_t kChunk = 64;
  const std::size_t chunks = (tree.nodes.size() + kChunk - 1) / kChunk;
  parallelFor(chunks, threads, [&](std::size_t chunk, std::size_t) {
    const std::size_t end = std::min(tree.nodes.size(), (chunk + 1) * kChunk);
    for (std::size_t n = chunk * kChunk; n < end; ++n) {
      TreeNode& node = tree.nodes[n];
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        if (node.children[lane].isEmpty()) continue;
        const Slot slot{static_cast<std::uint32_t>(n), lane};
        BoxF box = extents.box(slot, node.children[lane], node.boxes.get(static_cast<int>(lane)).axes);
        box.half_extents.array() += pad;
        node.boxes.set(static_cast<int>(lane), box);
      }
    }
  });
  writeAllLeafVertices(tree, mesh, origin, threads);
}

void writeAllLeafVertices(OwnedArrays& tree, const TriangleMesh& mesh, const Vec3& origin, int threads) {
  tree.leaf_vertices.resize(9 * tree.triangle_order.size() + kLanes);
  constexpr std::size_t kChunk = 64;
  const std::size_t chunks = (tree.nodes.size() + kChunk - 1) / kChunk;
  parallelFor(chunks, threads, [&](std::size_t chunk, std::size_t) {
    const std::size_t end = std::min(tree.nodes.size(), (chunk + 1) * kChunk);
    for (std::size_t n = chunk * kChunk; n < end; ++n) {
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        const Child leaf = tree.nodes[n].children[lane];
        if (!leaf.isLeaf()) continue;
        const BoxF box = tree.nodes[n].boxes.get(static_cast<int>(lane));
        writeLeafVertices(mesh, std::span(tree.triangle_order).subspan(leaf.first(), leaf.count()),
                          inMesh(box, origin), tree.leaf_vertices.data() + 9 * std::size_t{leaf.first()});
      }
    }
  });
}

}  // namespace octoblisk
