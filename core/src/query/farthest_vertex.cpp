#include "query/farthest_vertex.h"

#include <algorithm>
#include <array>
#include <limits>

#include "tree/tree.h"

namespace octoblisk::detail {
namespace {

/// Searches the tree and skips boxes that do not reach as far as the farthest vertex found so far.
class FarthestVertex {
 public:
  FarthestVertex(const Tree& tree, const Vec3& direction) : tree_(tree), direction_(direction) {}

  Vec3 find() {
    visit(tree_.child(Tree::kRoot));
    return vertex_;
  }

 private:
  struct Branch {
    double reach;  // of the child's box
    Child child;
  };

  void visit(Child child) {
    if (child.isLeaf()) {
      for (const std::uint32_t triangle : tree_.triangles(child)) visit(tree_.mesh().triangle(triangle));
      return;
    }
    std::array<Branch, kLanes> branches;
    std::size_t count = 0;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Slot slot{child.node(), lane};
      if (!tree_.child(slot).isEmpty()) branches[count++] = {reachOf(tree_.box(slot)), tree_.child(slot)};
    }
    std::ranges::sort(branches.begin(), branches.begin() + count, std::ranges::greater(), &Branch::reach);
    for (std::size_t k = 0; k < count && branches[k].reach >= reach_; ++k) visit(branches[k].child);
  }

  void visit(const Triangle& triangle) {
    for (const Vec3& corner : triangle) {
      const double reach = direction_.dot(corner);
      // Of equally far vertices, the first by coordinates: the answer depends on the mesh alone.
      if (reach < reach_ || (reach == reach_ && !std::ranges::lexicographical_compare(corner, vertex_)))
        continue;
      reach_ = reach;
      vertex_ = corner;
    }
  }

  double reachOf(const Obb& box) const {
    return direction_.dot(box.center) + (box.axes.transpose() * direction_).cwiseAbs().dot(box.half_extents);
  }

  const Tree& tree_;
  const Vec3 direction_;
  double reach_ = -std::numeric_limits<double>::infinity();
  Vec3 vertex_ = Vec3::Zero();
};

}  // namespace

Vec3 farthestVertex(const ClusteredOctree& tree, const Vec3& direction) {
  return FarthestVertex(treeOf(tree), direction).find();
}

}  // namespace octoblisk::detail
