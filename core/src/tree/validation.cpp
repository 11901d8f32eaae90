#include "tree/validation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tree/box_padding.h"

namespace octoblisk::detail {
namespace {

[[noreturn]] void reject(const std::string& what) { throw std::invalid_argument(what); }

std::string nameOf(Slot slot) {
  return "box " + std::to_string(slot.lane) + " of node " + std::to_string(slot.node);
}

void checkSizes(const TreeArrays& tree, std::size_t triangles) {
  if (tree.nodes.empty() == tree.compact_nodes.empty()) reject("there must be either full or compact nodes");
  if (tree.triangle_order.size() != triangles) {
    reject("the leaves hold " + std::to_string(tree.triangle_order.size()) + " triangles, but the mesh has " +
           std::to_string(triangles));
  }
  if (tree.leaf_vertices.size() != (tree.isCompact() ? 0 : leafVerticesSize(triangles))) {
    reject("the leaves have " + std::to_string(tree.leaf_vertices.size()) + " coordinates for " +
           std::to_string(triangles) + " triangles");
  }
}

/// Traverses all nodes, which must be stored in the order of the traversal, so that each is visited once.
class Walk {
 public:
  explicit Walk(const TreeArrays& tree) : tree_(tree), is_held_(tree.triangle_order.size(), false) {
    for (std::uint32_t lane = 1; lane < kLanes; ++lane) {
      if (!tree.children(0)[lane].isEmpty()) reject("the first node has more than one box");
    }
    node(0, 1);
    if (next_node_ != tree.nodeCount()) reject("node " + std::to_string(next_node_) + " has no parent");
    const auto missing = std::ranges::find(is_held_, false);
    if (missing != is_held_.end())
      reject("entry " + std::to_string(missing - is_held_.begin()) + " of the triangle order is in no leaf");
  }

 private:
  struct Below {
    std::size_t begin = std::numeric_limits<std::size_t>::max(), end = 0, count = 0;  ///< of the order

    void extend(const Below& other) {
      begin = std::min(begin, other.begin);
      end = std::max(end, other.end);
      count += other.count;
    }
  };

  Below node(std::uint32_t index, int depth) {
    if (depth > Tree::kMaxDepth) reject("the tree is deeper than " + std::to_string(Tree::kMaxDepth));
    Below below;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Slot slot{index, lane};
      const Child child = tree_.child(slot);
      if (child.isEmpty()) continue;
      if (child.isLeaf()) {
        below.extend(leaf(slot, child));
      } else if (child.node() == next_node_ && child.node() < tree_.nodeCount()) {
        ++next_node_;
        below.extend(node(child.node(), depth + 1));
      } else {
        reject("the child of " + nameOf(slot) + " is not the next node");
      }
    }
    if (below.count == 0) reject("node " + std::to_string(index) + " is empty");
    if (below.end - below.begin != below.count)
      reject("the triangles below node " + std::to_string(index) + " are not a range of the triangle order");
    return below;
  }

  Below leaf(Slot slot, Child leaf) {
    const Below range{leaf.first(), std::size_t{leaf.first()} + leaf.count(), leaf.count()};
    if (range.end > is_held_.size())
      reject("the leaf in " + nameOf(slot) + " ends beyond the triangle order");
    for (std::size_t place = range.begin; place < range.end; ++place) {
      if (is_held_[place])
        reject("entry " + std::to_string(place) + " of the triangle order is in more than one leaf");
      is_held_[place] = true;
    }
    return range;
  }

  const TreeArrays& tree_;
  std::vector<bool> is_held_;
  std::size_t next_node_ = 1;
};

void checkOrder(std::span<const std::uint32_t> order) {
  std::vector<bool> is_there(order.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i] >= order.size() || is_there[order[i]]) {
      reject("entry " + std::to_string(i) + " of the triangle order is triangle " + std::to_string(order[i]) +
             ", which does not exist or occurs twice");
    }
    is_there[order[i]] = true;
  }
}

/// Whether the box is finite, its frame orthonormal, its half extents in descending order, and its half
/// extents and centre no larger than a tree of this radius allows.
bool isSound(const BoxF& box, float largest) {
  const Mat3 axes = box.axes.cast<double>();
  const Mat3 off = axes.transpose() * axes - Mat3::Identity();
  const Eigen::Vector3f& half = box.half_extents;
  return box.center.cwiseAbs().maxCoeff() <= largest && box.center.allFinite() && half.allFinite() &&
         half[0] <= largest && half[0] >= half[1] && half[1] >= half[2] && half[2] >= 0.0f &&
         off.allFinite() && off.cwiseAbs().maxCoeff() <= kOrthonormal;
}

/// Whether the box is the empty box, which nothing overlaps.
bool isEmptyBox(const BoxF& box, float largest) {
  return box.axes.isIdentity(0.0f) && (box.half_extents.array() == Box8::kEmptyHalfExtent).all() &&
         box.center.allFinite() && box.center.cwiseAbs().maxCoeff() <= largest;
}

void checkLeafVertices(std::span<const float> coordinates, float largest) {
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (!(std::abs(coordinates[i]) <= largest))
      reject("coordinate " + std::to_string(i) + " in the leaves is not finite or too large for this mesh");
  }
}

/// Whether the corners stored in a leaf of a full tree are those of the mesh, up to rounding.
bool hasItsCorners(const Tree& tree, Slot slot) {
  const Child leaf = tree.child(slot);
  LeafVertices computed, unused;
  writeLeafVertices(tree.mesh(), tree.triangles(leaf), tree.arrays().box(slot), tree.origin(), computed.rows);
  const float* stored = tree.leafVertices(slot, unused);
  const float rounding = 0x1p-21f * tree.nodes()[slot.node].boxes.largestHalfExtent(slot.lane);
  return std::equal(stored, stored + 9 * leaf.count(), computed.rows,
                    [&](float a, float b) { return std::abs(a - b) <= rounding; });
}

}  // namespace

void checkTree(const TreeArrays& tree, const TriangleMesh& mesh) {
  checkSizes(tree, mesh.triangleCount());
  checkOrder(tree.triangle_order);
  const Walk walk(tree);
  const double radius = mesh.bounds().halfExtents().norm();
  const auto largest = static_cast<float>(4.0 * (radius + double(boxPadding(radius))));
  checkLeafVertices(tree.leaf_vertices, largest);
  for (std::uint32_t n = 0; n < tree.nodeCount(); ++n) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Slot slot{n, lane};
      if (tree.child(slot).isEmpty() ? !isEmptyBox(tree.box(slot), largest)
                                     : !isSound(tree.box(slot), largest))
        reject(nameOf(slot) + " cannot be a box of a tree of this mesh");
    }
  }
}

void checkThreads(int threads) {
  if (threads >= 0) return;
  throw std::invalid_argument("threads is " + std::to_string(threads) + ", but must not be negative");
}

void checkBuild(const TriangleMesh* mesh, const BuildOptions& options) {
  if (!mesh) throw std::invalid_argument("a clustered octree needs a mesh");
  const std::size_t triangles = mesh->triangleCount();
  if (triangles > ClusteredOctree::kMaxTriangles) {
    throw std::invalid_argument("the mesh has " + std::to_string(triangles) +
                                " triangles; a clustered octree holds at most " +
                                std::to_string(ClusteredOctree::kMaxTriangles));
  }
  if (options.leaf_capacity < 1 ||
      (options.partition == PartitionKind::clustering && options.leaf_capacity > kLanes)) {
    throw std::invalid_argument("leaf_capacity is " + std::to_string(options.leaf_capacity) +
                                ", but must be 1 to 8");
  }
  checkThreads(options.threads);
  if (options.clusters < 0 || options.clusters > kLanes) {
    throw std::invalid_argument("clusters is " + std::to_string(options.clusters) + ", but must be 0 to 8");
  }
  if (!options.part_of_triangle.empty() && options.part_of_triangle.size() != triangles) {
    throw std::invalid_argument("part_of_triangle has " + std::to_string(options.part_of_triangle.size()) +
                                " entries for " + std::to_string(triangles) + " triangles");
  }
}

void checkDeformed(const TriangleMesh* deformed, const TriangleMesh& mesh) {
  if (!deformed) throw std::invalid_argument("refitting a clustered octree needs a mesh");
  const auto checkCount = [](const char* what, std::size_t count, std::size_t wanted) {
    if (count == wanted) return;
    throw std::invalid_argument("the deformed mesh has " + std::to_string(count) + ' ' + what +
                                ", but the tree's mesh has " + std::to_string(wanted));
  };
  checkCount("triangles", deformed->triangleCount(), mesh.triangleCount());
  checkCount("vertices", deformed->vertices().size(), mesh.vertices().size());
  const auto [other, own] = std::ranges::mismatch(deformed->triangles(), mesh.triangles());
  if (own != mesh.triangles().end()) {
    throw std::invalid_argument("triangle " + std::to_string(own - mesh.triangles().begin()) +
                                " of the deformed mesh has other vertices than in the tree's mesh");
  }
}

void validate(const Tree& tree) {
  std::vector<std::uint32_t> leaves_of_triangle(tree.mesh().triangleCount(), 0);
  std::vector<Slot> path;  // from the root to the current slot
  const auto fail = [](const std::string& what) {
    throw std::logic_error("the clustered octree is invalid: " + what);
  };

  const auto visit = [&](const auto& self, Slot slot) -> void {
    path.push_back(slot);
    if (path.size() > static_cast<std::size_t>(Tree::kMaxDepth))
      fail("it is deeper than " + std::to_string(Tree::kMaxDepth));
    const Child here = tree.child(slot);
    if (here.isLeaf()) {
      if (!tree.isCompact() && !hasItsCorners(tree, slot)) {
        fail("the corners in leaf " + std::to_string(slot.lane) + " of node " + std::to_string(slot.node) +
             " are not those of its triangles");
      }
      for (const std::uint32_t t : tree.triangles(here)) {
        ++leaves_of_triangle[t];
        for (const Slot above : path) {
          const Obb bounds =
              inMesh(tree.arrays().box(above), Vec3::Zero());  // exact, however far away the origin is
          for (const Vec3& vertex : tree.mesh().triangle(t)) {
            if (!bounds.contains(vertex - tree.origin())) {
              fail("box " + std::to_string(above.lane) + " of node " + std::to_string(above.node) +
                   " does not contain triangle " + std::to_string(t));
            }
          }
        }
      }
    } else {
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        if (!tree.child({here.node(), lane}).isEmpty()) self(self, {here.node(), lane});
      }
    }
    path.pop_back();
  };
  visit(visit, Tree::kRoot);

  for (std::size_t t = 0; t < leaves_of_triangle.size(); ++t) {
    if (leaves_of_triangle[t] != 1) {
      fail("triangle " + std::to_string(t) + " is in " + std::to_string(leaves_of_triangle[t]) + " leaves");
    }
  }
}

}  // namespace octoblisk::detail
