#include "tree/tree.h"

#include <algorithm>
#include <utility>

#include "tree/refit.h"
#include "tree/validation.h"

namespace octoblisk::detail {
namespace {

BuildStats statsOf(const TreeArrays& tree, std::size_t triangles) {
  BuildStats stats;
  stats.triangles = triangles;
  stats.nodes = tree.nodeCount();
  stats.bytes = tree.bytes();
  const auto volume = [&](Slot slot) { return 8.0 * tree.box(slot).half_extents.cast<double>().prod(); };
  stats.root_volume = volume(Tree::kRoot);
  std::vector<int> depth(tree.nodeCount(), 0);  // number of boxes around each node
  forEachChild(tree, [&](Slot slot, Child child) {
    const int depth_of_child = depth[slot.node] + 1;
    if (!child.isLeaf()) {
      depth[child.node()] = depth_of_child;
      return;
    }
    ++stats.leaves;
    stats.leaf_volume += volume(slot);
    stats.depth = std::max(stats.depth, depth_of_child);
  });
  return stats;
}

}  // namespace

Tree::Tree(std::shared_ptr<const TriangleMesh> mesh, OwnedArrays arrays, BuildOptions options)
    : Tree(std::move(mesh), arrays.view(), nullptr, std::move(options)) {
  owned_ = std::move(arrays);  // the memory stays in place
}

Tree::Tree(std::shared_ptr<const TriangleMesh> mesh, const TreeArrays& arrays,
           std::shared_ptr<const void> owner, BuildOptions options)
    : mesh_(std::move(mesh)), owner_(std::move(owner)), arrays_(arrays), options_(std::move(options)) {
  measure();
}

void Tree::refit(std::shared_ptr<const TriangleMesh> deformed, int threads) {
  detail::refit(owned_, *deformed, threads);
  mesh_ = std::move(deformed);
  measure();
}

void Tree::measure() {
  origin_ = mesh_->bounds().center();
  radius_ = mesh_->bounds().halfExtents().norm();
  stats_ = statsOf(arrays_, mesh_->triangleCount());
}

Obb Tree::box(Slot slot) const { return inMesh(arrays_.box(slot), origin_); }

void Tree::computeLeafVertices(Slot slot, LeafVertices& room) const {
  writeLeafVertices(*mesh_, triangles(child(slot)), arrays_.box(slot), origin_, room.rows);
}

ClusteredOctree octreeOver(std::shared_ptr<const TriangleMesh> mesh, const TreeArrays& arrays,
                           std::shared_ptr<const void> owner, const BuildOptions& options) {
  checkBuild(mesh.get(), options);
  checkTree(arrays, *mesh);
  return TreeAccess::octree(std::make_shared<Tree>(std::move(mesh), arrays, std::move(owner), options));
}

}  // namespace octoblisk::detail
