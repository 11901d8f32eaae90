#include "octoblisk/clustered_octree.h"

#include <utility>

#include "tree/refit.h"
#include "tree/tree.h"
#include "tree/validation.h"

namespace octoblisk {

using namespace detail;

ClusteredOctree::ClusteredOctree(std::shared_ptr<Tree> tree) : tree_(std::move(tree)) {}

ClusteredOctree ClusteredOctree::refitted(std::shared_ptr<const TriangleMesh> deformed, int threads) const& {
  checkThreads(threads);
  checkDeformed(deformed.get(), mesh());
  OwnedArrays copy(tree_->arrays());
  refit(copy, *deformed, threads);
  return ClusteredOctree(std::make_shared<Tree>(std::move(deformed), std::move(copy), options()));
}

ClusteredOctree ClusteredOctree::refitted(std::shared_ptr<const TriangleMesh> deformed, int threads) && {
  if (tree_.use_count() != 1 || !tree_->ownsArrays())
    return std::as_const(*this).refitted(std::move(deformed), threads);
  std::shared_ptr<Tree>(tree_).reset();  // synchronises with all threads that have given up their share
  checkThreads(threads);
  checkDeformed(deformed.get(), mesh());
  tree_->refit(std::move(deformed), threads);
  return ClusteredOctree(std::move(tree_));
}

const TriangleMesh& ClusteredOctree::mesh() const { return tree_->mesh(); }
const std::shared_ptr<const TriangleMesh>& ClusteredOctree::sharedMesh() const { return tree_->sharedMesh(); }
const BuildOptions& ClusteredOctree::options() const { return tree_->options(); }
const BuildStats& ClusteredOctree::stats() const { return tree_->stats(); }

void ClusteredOctree::validate() const { detail::validate(*tree_); }

std::vector<Obb> ClusteredOctree::boxes(int depth) const {
  const Tree& tree = *tree_;
  std::vector<Obb> found;
  std::vector<std::pair<Slot, int>> open = {{Tree::kRoot, 0}};
  while (!open.empty()) {
    const auto [slot, level] = open.back();
    open.pop_back();
    const Child here = tree.child(slot);
    if (level >= depth || here.isLeaf()) {
      found.push_back(tree.box(slot));
      continue;
    }
    for (std::uint32_t lane = kLanes; lane-- > 0;) {
      if (!tree.child({here.node(), lane}).isEmpty()) open.push_back({{here.node(), lane}, level + 1});
    }
  }
  return found;
}

}  // namespace octoblisk
