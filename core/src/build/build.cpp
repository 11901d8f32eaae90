// Builds a tree: partitions the mesh, writes the partition's nodes as eight boxes each, and adds the leaves'
// corners.
#include <algorithm>
#include <utility>

#include "base/huge_pages.h"
#include "build/make_compact.h"
#include "build/paper/paper_partition.h"
#include "build/partition.h"
#include "tree/box_padding.h"
#include "tree/leaf_vertices.h"
#include "tree/tree.h"
#include "tree/validation.h"

namespace octoblisk {

using namespace detail;

namespace {

Partition partitionOf(TriangleRecords records, const BuildOptions& options) {
  if (options.partition == PartitionKind::clustering) {
    return clusteringPartition(std::move(records), options);
  }
  return paperPartition(records.span(), {.clusters = static_cast<std::size_t>(options.clusters),
                                         .seed = options.seed,
                                         .part_of_triangle = options.part_of_triangle,
                                         .leaf_capacity = static_cast<std::size_t>(options.leaf_capacity)});
}

/// Grows a box to allow for the rounding of vertices, projections and box centres to single precision.
BoxF padded(BoxF box, float pad) {
  box.half_extents.array() += pad;
  return box;
}

/// Writes the partition's nodes as eight boxes each, depth first.
class NodeWriter {
 public:
  NodeWriter(const Partition& partition, float pad, std::vector<TreeNode>& nodes)
      : partition_(partition), pad_(pad), nodes_(nodes) {}

  /// Writes the partition's node into a slot, and everything below it into new nodes.
  void write(std::uint32_t partition_node, Slot slot) {
    const PartitionNode& source = partition_.nodes[partition_node];
    nodes_[slot.node].boxes.set(slot.lane, padded(source.box, pad_));
    Child& child = nodes_[slot.node].children[slot.lane];
    if (source.child_count == 0) {
      child = Child::leaf(source.begin, source.count());
      return;
    }
    const auto node = static_cast<std::uint32_t>(nodes_.size());
    child = Child::node(node);
    nodes_.emplace_back();
    for (std::uint32_t lane = 0; lane < source.child_count; ++lane) {
      write(source.first_child + lane, {node, lane});
    }
  }

 private:
  const Partition& partition_;
  const float pad_;
  std::vector<TreeNode>& nodes_;
};

}  // namespace

ClusteredOctree ClusteredOctree::build(std::shared_ptr<const TriangleMesh> mesh,
                                       const BuildOptions& options) {
  checkBuild(mesh.get(), options);
  Partition partition = partitionOf(makeRecords(*mesh, mesh->bounds().center(), options.threads), options);

  OwnedArrays arrays;
  arrays.triangle_order = std::move(partition.order);
  const auto has_children = [](const PartitionNode& node) { return node.child_count > 0; };
  reserveOnHugePages(arrays.nodes,
                     1 + static_cast<std::size_t>(std::ranges::count_if(partition.nodes, has_children)));
  arrays.nodes.emplace_back();
  NodeWriter(partition, boxPadding(mesh->bounds().halfExtents().norm()), arrays.nodes).write(0, Tree::kRoot);
  if (options.storage == Storage::compact) {
    makeCompact(arrays, *mesh, options.threads);
  } else {
    writeAllLeafVertices(arrays, *mesh, options.threads);
  }
  return TreeAccess::octree(std::make_shared<Tree>(std::move(mesh), std::move(arrays), options));
}

}  // namespace octoblisk
