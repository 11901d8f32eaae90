#include "octoblisk/clustered_octree.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "octoblisk/huge_pages.h"
#include "octoblisk/parallel.h"
#include "octoblisk/partition.h"
#include "octoblisk/refit.h"
#include "octoblisk/tree_check.h"

namespace octoblisk {
namespace {

void checkThreads(int threads) {
  if (threads >= 0) return;
  throw std::invalid_argument("threads is " + std::to_string(threads) + ", but must not be negative");
}

void check(const std::shared_ptr<const TriangleMesh>& mesh, const BuildOptions& options) {
  if (!mesh) throw std::invalid_argument("a clustered octree needs a mesh");
  const std::size_t triangles = mesh->triangleCount();
  if (triangles > ClusteredOctree::kMaxTriangles) {
    throw std::invalid_argument("the mesh has " + std::to_string(triangles) +
                                " triangles; a clustered octree holds " +
                                std::to_string(ClusteredOctree::kMaxTriangles));
  }
  if (options.leaf_capacity < 1 ||
      (options.partition == PartitionKind::clustering && options.leaf_capacity > kLanes)) {
    throw std::invalid_argument("leaf_capacity is " + std::to_string(options.leaf_capacity) +
                                ", but must be 1 to 8");
  }
  checkThreads(options.threads);
  if (options.clusters < 1 || options.clusters > kLanes) {
    throw std::invalid_argument("clusters is " + std::to_string(options.clusters) + ", but must be 1 to 8");
  }
  if (!options.part_of_triangle.empty() && options.part_of_triangle.size() != triangles) {
    throw std::invalid_argument("part_of_triangle has " + std::to_string(options.part_of_triangle.size()) +
                                " entries for " + std::to_string(triangles) + " triangles");
  }
}

Partition partitionOf(TriangleRecords records, const BuildOptions& options) {
  if (options.partition == PartitionKind::clustering) {
    return clusteringPartition(std::move(records),
                               {options.leaf_capacity, options.quality, threadCount(options.threads)});
  }
  return paperPartition(
      records.span(), {options.leaf_capacity,
                       {static_cast<std::size_t>(options.clusters), options.seed, options.part_of_triangle}});
}

/// Room for the rounding of vertices, projections and box centres to single precision.
BoxF padded(BoxF box, float pad) {
  box.half_extents.array() += pad;
  return box;
}

/// Writes the partition's nodes as eight boxes each, depth first.
class NodeWriter {
 public:
  NodeWriter(const Partition& partition, float pad, std::vector<ClusteredOctree::Node>& nodes)
      : partition_(partition), pad_(pad), nodes_(nodes) {}

  /// Puts the partition's node into a slot, and all below it into new nodes.
  void write(std::uint32_t partition_node, Slot slot) {
    const PartitionNode& source = partition_.nodes[partition_node];
    nodes_[slot.node].boxes.set(static_cast<int>(slot.lane), padded(source.box, pad_));
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
  std::vector<ClusteredOctree::Node>& nodes_;
};

/// Throws unless the mesh is the other one with its vertices moved.
void checkDeformed(const TriangleMesh* deformed, const TriangleMesh& mesh) {
  if (!deformed) throw std::invalid_argument("to refit a clustered octree needs a mesh");
  const auto checkCount = [](const char* what, std::size_t count, std::size_t wanted) {
    if (count == wanted) return;
    throw std::invalid_argument("the deformed mesh has " + std::to_string(count) + ' ' + what +
                                ", the tree's " + std::to_string(wanted));
  };
  checkCount("triangles", deformed->triangleCount(), mesh.triangleCount());
  checkCount("vertices", deformed->vertices().size(), mesh.vertices().size());
  const auto [other, own] = std::ranges::mismatch(deformed->triangles(), mesh.triangles());
  if (own != mesh.triangles().end()) {
    throw std::invalid_argument("triangle " + std::to_string(own - mesh.triangles().begin()) +
                                " of the deformed mesh has other vertices than that of the tree's");
  }
}

BuildStats statsOf(const TreeArrays& tree, std::size_t triangles) {
  BuildStats stats;
  stats.triangles = triangles;
  stats.nodes = tree.nodeCount();
  stats.bytes = tree.bytes();
  const auto volume = [&](Slot slot) { return 8.0 * tree.box(slot).half_extents.cast<double>().prod(); };
  stats.root_volume = volume(ClusteredOctree::kRoot);
  std::vector<int> depth(tree.nodeCount(), 0);  // boxes round a node
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

/// Whether the corners in a leaf of a fast tree are those of the mesh, but for rounding.
bool hasItsCorners(const ClusteredOctree& tree, Slot slot) {
  const Child leaf = tree.child(slot);
  LeafVertices computed, unused;
  writeLeafVertices(tree.mesh(), tree.triangles(leaf), tree.arrays().box(slot), tree.origin(), computed.rows);
  const float* stored = tree.leafVertices(slot, unused);
  const float rounding = 0x1p-21f * tree.nodes()[slot.node].boxes.largestHalfExtent(slot.lane);
  return std::equal(stored, stored + 9 * leaf.count(), computed.rows,
                    [&](float a, float b) { return std::abs(a - b) <= rounding; });
}

}  // namespace

ClusteredOctree::ClusteredOctree(std::shared_ptr<const TriangleMesh> mesh, const TreeArrays& arrays,
                                 std::shared_ptr<const void> owner, std::shared_ptr<OwnedArrays> owned,
                                 BuildOptions options)
    : mesh_(std::move(mesh)),
      origin_(mesh_->bounds().center()),
      radius_(mesh_->bounds().halfExtents().norm()),
      arrays_(arrays),
      owner_(std::move(owner)),
      owned_(std::move(owned)),
      options_(std::move(options)),
      stats_(statsOf(arrays_, mesh_->triangleCount())) {}

ClusteredOctree::ClusteredOctree(std::shared_ptr<const TriangleMesh> mesh, std::shared_ptr<OwnedArrays> owned,
                                 BuildOptions options)
    // In braces, so that the view is taken before the owner moves on.
    : ClusteredOctree{std::move(mesh), owned->view(), nullptr, std::move(owned), std::move(options)} {}

ClusteredOctree ClusteredOctree::over(std::shared_ptr<const TriangleMesh> mesh, const TreeArrays& arrays,
                                      std::shared_ptr<const void> owner, const BuildOptions& options) {
  check(mesh, options);
  checkTree(arrays, *mesh);
  return ClusteredOctree(std::move(mesh), arrays, std::move(owner), nullptr, options);
}

ClusteredOctree ClusteredOctree::build(std::shared_ptr<const TriangleMesh> mesh,
                                       const BuildOptions& options) {
  check(mesh, options);
  const int threads = threadCount(options.threads);
  const Vec3 origin = mesh->bounds().center();
  const double radius = mesh->bounds().halfExtents().norm();
  Partition partition = partitionOf(makeRecords(*mesh, origin, threads), options);

  const auto arrays = std::make_shared<OwnedArrays>();
  arrays->triangle_order = std::move(partition.order);
  const auto has_children = [](const PartitionNode& node) { return node.child_count > 0; };
  reserveOnHugePages(arrays->nodes,
                     1 + static_cast<std::size_t>(std::ranges::count_if(partition.nodes, has_children)));
  arrays->nodes.emplace_back();
  NodeWriter(partition, boxPadding(radius), arrays->nodes).write(0, kRoot);
  if (options.storage == Storage::compact) {
    makeCompact(*arrays, *mesh, origin, radius, threads);
  } else {
    writeAllLeafVertices(*arrays, *mesh, origin, threads);
  }
  return ClusteredOctree(std::move(mesh), arrays, options);
}

ClusteredOctree ClusteredOctree::refitted(std::shared_ptr<const TriangleMesh> deformed, int threads) const& {
  checkThreads(threads);
  checkDeformed(deformed.get(), *mesh_);
  const auto copy = std::make_shared<OwnedArrays>(arrays_);
  refit(*copy, *deformed, deformed->bounds().center(), deformed->bounds().halfExtents().norm(),
        threadCount(threads));
  return ClusteredOctree(std::move(deformed), copy, options_);
}

ClusteredOctree ClusteredOctree::refitted(std::shared_ptr<const TriangleMesh> deformed, int threads) && {
  if (owned_.use_count() != 1) return std::as_const(*this).refitted(std::move(deformed), threads);
  std::shared_ptr<OwnedArrays>(owned_).reset();  // comes after all that those did who gave up their share
  checkThreads(threads);
  checkDeformed(deformed.get(), *mesh_);
  refit(*owned_, *deformed, deformed->bounds().center(), deformed->bounds().halfExtents().norm(),
        threadCount(threads));
  return ClusteredOctree(std::move(deformed), std::move(owned_), std::move(options_));
}

void ClusteredOctree::computeLeafVertices(Slot slot, LeafVertices& room) const {
  writeLeafVertices(*mesh_, triangles(child(slot)), arrays_.box(slot), origin_, room.rows);
}

Obb ClusteredOctree::box(Slot slot) const { return inMesh(arrays_.box(slot), origin_); }

std::vector<Obb> ClusteredOctree::boxes(int depth) const {
  std::vector<Obb> found;
  std::vector<std::pair<Slot, int>> open = {{kRoot, 0}};
  while (!open.empty()) {
    const auto [slot, level] = open.back();
    open.pop_back();
    const Child here = child(slot);
    if (level == depth || here.isLeaf()) {
      found.push_back(box(slot));
      continue;
    }
    for (std::uint32_t lane = kLanes; lane-- > 0;) {
      if (!child({here.node(), lane}).isEmpty()) open.push_back({{here.node(), lane}, level + 1});
    }
  }
  return found;
}

void ClusteredOctree::validate() const {
  std::vector<std::uint32_t> leaves_of_triangle(mesh_->triangleCount(), 0);
  std::vector<Slot> path;  // from the root to the slot at hand
  const auto fail = [](const std::string& what) {
    throw std::logic_error("the clustered octree is invalid: " + what);
  };

  const auto visit = [&](const auto& self, Slot slot) -> void {
    path.push_back(slot);
    if (path.size() > static_cast<std::size_t>(kMaxDepth))
      fail("it is deeper than " + std::to_string(kMaxDepth));
    const Child here = child(slot);
    if (here.isLeaf()) {
      if (!isCompact() && !hasItsCorners(*this, slot)) {
        fail("the corners in leaf " + std::to_string(slot.lane) + " of node " + std::to_string(slot.node) +
             " are not those of its triangles");
      }
      for (const std::uint32_t t : triangles(here)) {
        ++leaves_of_triangle[t];
        for (const Slot above : path) {
          const Obb bounds = inMesh(arrays_.box(above), Vec3::Zero());  // exact, however far the origin is
          for (const Vec3& vertex : mesh_->triangle(t)) {
            if (!bounds.contains(vertex - origin_)) {
              fail("box " + std::to_string(above.lane) + " of node " + std::to_string(above.node) +
                   " does not hold triangle " + std::to_string(t));
            }
          }
        }
      }
    } else {
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        if (!child({here.node(), lane}).isEmpty()) self(self, {here.node(), lane});
      }
    }
    path.pop_back();
  };
  visit(visit, kRoot);

  for (std::size_t t = 0; t < leaves_of_triangle.size(); ++t) {
    if (leaves_of_triangle[t] != 1) {
      fail("triangle " + std::to_string(t) + " is in " + std::to_string(leaves_of_triangle[t]) + " leaves");
    }
  }
}

}  // namespace octoblisk
