#include "models/shared_tree.h"

#include <utility>

namespace octoblisk::demos {

std::shared_ptr<const ClusteredOctree> treeOf(std::shared_ptr<const TriangleMesh> mesh) {
  return std::make_shared<const ClusteredOctree>(ClusteredOctree::build(std::move(mesh)));
}

std::shared_ptr<const ClusteredOctree> treeOf(TriangleMesh mesh) {
  return treeOf(std::make_shared<const TriangleMesh>(std::move(mesh)));
}

}  // namespace octoblisk::demos
