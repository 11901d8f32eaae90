#include "paper/box_detection.h"

#include <vector>

#include "geometry/bounding_box.h"
#include "octoblisk/collide.h"
#include "octoblisk/convex.h"
#include "tree/tree.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

/// Descends from the root to the leaves with points, through cells that pass `keep`, until visit(cell, leaf)
/// returns true; then returns true.
template <typename Keep, typename Visit>
bool descend(const Octree& octree, const Octree::Node& node, const Keep& keep, const Visit& visit) {
  if (node.count() == 0) return false;
  const Obb cell = octree.cell(node);
  if (!keep(cell)) return false;
  if (node.isLeaf()) return visit(cell, node);
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    if (descend(octree, octree.nodes()[node.first_child + octant], keep, visit)) return true;
  }
  return false;
}

template <typename Keep, typename Visit>
bool descend(const Segmentation& blisk, const Keep& keep, const Visit& visit) {
  for (const Octree& octree : blisk.octrees()) {
    const auto visitCell = [&](const Obb& cell, const Octree::Node&) { return visit(cell); };
    if (descend(octree, octree.nodes().front(), keep, visitCell)) return true;
  }
  return false;
}

/// The slots below a box that is not a leaf.
template <typename Visit>
void forEachBelow(const Tree& tree, Slot slot, const Visit& visit) {
  const std::uint32_t node = tree.child(slot).node();
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    if (!tree.child({node, lane}).isEmpty()) visit(Slot{node, lane});
  }
}

/// The same in a clustered octree, whose leaf boxes contain whole triangles.
template <typename Keep, typename Visit>
bool descend(const Tree& tree, Slot slot, const Keep& keep, const Visit& visit) {
  const Obb box = tree.box(slot);
  if (!keep(box)) return false;
  if (tree.child(slot).isLeaf()) return visit(box);
  bool stop = false;
  forEachBelow(tree, slot, [&](Slot below) { stop = stop || descend(tree, below, keep, visit); });
  return stop;
}

/// A box of the body, in the blisk's frame.
struct BodyBox {
  Slot slot;
  Obb box;
};

class PairDescent {
 public:
  PairDescent(const Tree& blisk, const Tree& body, const Pose& body_in_blisk)
      : blisk_(blisk), body_(body), body_in_blisk_(body_in_blisk) {}

  BoxesLeft find() {
    visit(Tree::kRoot, {bodyBox(Tree::kRoot)});
    return left_;
  }

 private:
  BodyBox bodyBox(Slot slot) const { return {slot, body_in_blisk_ * body_.box(slot)}; }

  /// `near` are the body's boxes that may overlap; none is below another.
  void visit(Slot slot, std::vector<BodyBox> near) {
    const Obb box = blisk_.box(slot);
    const bool is_leaf = blisk_.child(slot).isLeaf();
    std::vector<BodyBox> overlapping;
    while (!near.empty()) {
      const BodyBox candidate = near.back();
      near.pop_back();
      ++left_.tested;
      if (!overlaps(box, candidate.box)) continue;
      const bool body_is_leaf = body_.child(candidate.slot).isLeaf();
      if (is_leaf && body_is_leaf) {
        ++left_.leaves;
        left_.volume += box.volume();
        return;
      }
      const bool divide_body = !body_is_leaf && (is_leaf || candidate.box.volume() > box.volume());
      if (!divide_body) {
        overlapping.push_back(candidate);
        continue;
      }
      forEachBelow(body_, candidate.slot, [&](Slot below) { near.push_back(bodyBox(below)); });
    }
    if (overlapping.empty()) return;
    forEachBelow(blisk_, slot, [&](Slot below) { visit(below, overlapping); });
  }

  const Tree &blisk_, &body_;
  const Pose body_in_blisk_;
  BoxesLeft left_;
};

/// The leaf boxes that a descent finds through boxes that overlap a box.
template <typename Descend>
BoxesLeft leftBy(const Obb& box, SeparatingAxes axes, const Descend& descendAll) {
  BoxesLeft left;
  const auto near = [&](const Obb& here) {
    ++left.tested;
    return overlaps(box, here, axes);
  };
  descendAll(near, [&](const Obb& leaf) {
    ++left.leaves;
    left.volume += leaf.volume();
    return false;
  });
  return left;
}

/// Whether a triangle of the body meets a box of the blisk.
auto meeting(const ClusteredOctree& body, const Pose& body_in_blisk) {
  return [&body, blisk_in_body = body_in_blisk.inverse()](const Obb& box) {
    return collide(body, ConvexBox(box), blisk_in_body).has_value();
  };
}

constexpr auto kAnyLeaf = [](const Obb&) { return true; };

}  // namespace

BoxesLeft leavesNear(const Segmentation& blisk, const Obb& box, SeparatingAxes axes) {
  return leftBy(box, axes, [&](const auto& near, const auto& visit) { descend(blisk, near, visit); });
}

BoxesLeft leavesNear(const ClusteredOctree& blisk, const Obb& box) {
  return leftBy(box, SeparatingAxes::exact15, [&](const auto& near, const auto& visit) {
    descend(detail::treeOf(blisk), Tree::kRoot, near, visit);
  });
}

BoxesLeft leavesNear(const ClusteredOctree& blisk, const ClusteredOctree& body, const Pose& body_in_blisk) {
  return PairDescent(detail::treeOf(blisk), detail::treeOf(body), body_in_blisk).find();
}

bool anyLeafNear(const Segmentation& blisk, const Obb& box) {
  return descend(
      blisk, [&](const Obb& cell) { return overlaps(box, cell); }, kAnyLeaf);
}

bool anyLeafMeets(const Segmentation& blisk, const ClusteredOctree& body, const Pose& body_in_blisk) {
  return descend(blisk, meeting(body, body_in_blisk), kAnyLeaf);
}

bool anyLeafMeets(const ClusteredOctree& blisk, const ClusteredOctree& body, const Pose& body_in_blisk) {
  return descend(detail::treeOf(blisk), Tree::kRoot, meeting(body, body_in_blisk), kAnyLeaf);
}

bool anyFittedBoxMeets(std::span<const Points> clusters, const Segmentation& blisk,
                       const ClusteredOctree& body, const Pose& body_in_blisk) {
  const auto meets = meeting(body, body_in_blisk);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const Octree& octree = blisk.octrees()[c];
    const auto fittedMeets = [&](const Obb& cell, const Octree::Node& leaf) {
      Points points;
      for (std::uint32_t i = leaf.begin; i < leaf.end; ++i) points.push_back(clusters[c][octree.order()[i]]);
      return meets(boundingBox(points, cell.axes));
    };
    if (descend(octree, octree.nodes().front(), meets, fittedMeets)) return true;
  }
  return false;
}

}  // namespace octoblisk::demos
