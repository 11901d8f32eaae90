#include "other_trees.h"

#include <span>

#include "build/paper/principal_box.h"
#include "tree/tree.h"

namespace octoblisk::bench {

using namespace detail;

namespace {

/// Makes a tree from arrays whose nodes and axes are right, and fits its boxes to their contents.
ClusteredOctree fitted(const std::shared_ptr<const TriangleMesh>& mesh, OwnedArrays arrays) {
  const auto owner = std::make_shared<const OwnedArrays>(std::move(arrays));
  return octreeOver(mesh, owner->view(), owner, {}).refitted(mesh);
}

/// Rewrites the nodes of a tree depth first, with fewer children each.
class Narrower {
 public:
  Narrower(const ClusteredOctree& tree, std::size_t children) : tree_(treeOf(tree)), most_(children) {
    arrays_.triangle_order.assign(tree_.triangleOrder().begin(), tree_.triangleOrder().end());
    arrays_.leaf_vertices.assign(tree_.arrays().leaf_vertices.begin(), tree_.arrays().leaf_vertices.end());
    arrays_.nodes.emplace_back();
    write(Tree::kRoot, {0, 0});
  }

  OwnedArrays take() { return std::move(arrays_); }

 private:
  /// Writes a box of the tree and its subtree into a slot.
  void write(Slot from, Slot to) {
    const Child child = tree_.child(from);
    set(to, tree_.arrays().box(from));
    if (child.isLeaf()) {
      arrays_.nodes[to.node].children[to.lane] = child;
      return;
    }
    std::vector<Slot> below;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      if (!tree_.child({child.node(), lane}).isEmpty()) below.push_back({child.node(), lane});
    }
    writeBelow(below, to);
  }

  /// Makes a node from boxes that are consecutive in the order of their triangles, and makes the slot its
  /// parent.
  void writeBelow(std::span<const Slot> boxes, Slot parent) {
    const auto node = static_cast<std::uint32_t>(arrays_.nodes.size());
    arrays_.nodes[parent.node].children[parent.lane] = Child::node(node);
    arrays_.nodes.emplace_back();
    const std::size_t groups = std::min(most_, boxes.size());
    for (std::size_t g = 0; g < groups; ++g) {
      const std::size_t begin = g * boxes.size() / groups, end = (g + 1) * boxes.size() / groups;
      const Slot slot{node, static_cast<std::uint32_t>(g)};
      if (end - begin == 1) {
        write(boxes[begin], slot);
        continue;
      }
      const std::span<const Slot> group = boxes.subspan(begin, end - begin);
      set(slot, boxAround(group));
      writeBelow(group, slot);
    }
  }

  BoxF boxAround(std::span<const Slot> boxes) const {
    std::vector<Vec3> points;
    for (const Slot slot : boxes) addCorners(slot, points);
    const Obb box = principalBox(points);
    return {(box.center - tree_.origin()).cast<float>(), box.axes.cast<float>(),
            box.half_extents.cast<float>()};
  }

  void addCorners(Slot slot, std::vector<Vec3>& points) const {
    const Child child = tree_.child(slot);
    if (child.isLeaf()) {
      for (const std::uint32_t t : tree_.triangles(child)) {
        for (const Vec3& corner : tree_.mesh().triangle(t)) points.push_back(corner);
      }
      return;
    }
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      if (!tree_.child({child.node(), lane}).isEmpty()) addCorners({child.node(), lane}, points);
    }
  }

  void set(Slot slot, const BoxF& box) { arrays_.nodes[slot.node].boxes.set(slot.lane, box); }

  const Tree& tree_;
  const std::size_t most_;
  OwnedArrays arrays_;
};

}  // namespace

MakeTree axisAligned(Aligned which) {
  return [which](const std::shared_ptr<const TriangleMesh>& mesh) {
    const ClusteredOctree tree = ClusteredOctree::build(mesh);
    OwnedArrays arrays(treeOf(tree).arrays());
    forEachChild(treeOf(tree).arrays(), [&](Slot slot, Child child) {
      if (which != Aligned::all && child.isLeaf() != (which == Aligned::leaves)) return;
      BoxF box = treeOf(tree).arrays().box(slot);
      box.axes.setIdentity();
      arrays.nodes[slot.node].boxes.set(slot.lane, box);
    });
    return fitted(mesh, std::move(arrays));
  };
}

MakeTree narrowed(std::size_t children) {
  return [children](const std::shared_ptr<const TriangleMesh>& mesh) {
    return fitted(mesh, Narrower(ClusteredOctree::build(mesh), children).take());
  };
}

}  // namespace octoblisk::bench
