#include "octoblisk/clustered_octree.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "octoblisk/huge_pages.h"
#include "octoblisk/parallel.h"
#include "octoblisk/partition.h"

namespace octoblisk {
namespace {

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
  if (options.threads < 0) {
    throw std::invalid_argument("threads is " + std::to_string(options.threads) +
                                ", but must not be negative");
  }
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
  return paperPartition(records.span(), {options.leaf_capacity, static_cast<std::size_t>(options.clusters),
                                         options.seed, options.part_of_triangle});
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

  int depth() const { return depth_; }

  /// Puts the partition's node into a slot, and all below it into new nodes.
  void write(std::uint32_t partition_node, Slot slot, int depth) {
    const PartitionNode& source = partition_.nodes[partition_node];
    depth_ = std::max(depth_, depth);
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
      write(source.first_child + lane, {node, lane}, depth + 1);
    }
  }

 private:
  const Partition& partition_;
  const float pad_;
  std::vector<ClusteredOctree::Node>& nodes_;
  int depth_ = 0;
};

template <typename Visit>
void forEachChild(const std::vector<ClusteredOctree::Node>& nodes, Visit&& visit) {
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      if (!nodes[n].children[lane].isEmpty()) visit(Slot{n, lane}, nodes[n].children[lane]);
    }
  }
}

}  // namespace

ClusteredOctree ClusteredOctree::build(std::shared_ptr<const TriangleMesh> mesh,
                                       const BuildOptions& options) {
  check(mesh, options);
  ClusteredOctree tree;
  tree.mesh_ = std::move(mesh);
  tree.options_ = options;
  tree.origin_ = tree.mesh_->bounds().center();
  tree.radius_ = tree.mesh_->bounds().halfExtents().norm();

  Partition partition =
      partitionOf(makeRecords(*tree.mesh_, tree.origin_, threadCount(options.threads)), options);
  tree.triangle_order_ = std::move(partition.order);

  constexpr double kRounding = 0x1p-20;  // of the radius: sixteen units in the last place
  constexpr auto kSmallest = static_cast<double>(std::numeric_limits<float>::min());
  const auto has_children = [](const PartitionNode& node) { return node.child_count > 0; };
  reserveOnHugePages(
      tree.nodes_, 1 + static_cast<std::size_t>(std::ranges::count_if(partition.nodes, has_children)));
  tree.nodes_.emplace_back();
  NodeWriter writer(partition, static_cast<float>(kRounding * tree.radius_ + kSmallest), tree.nodes_);
  writer.write(0, kRoot, 1);

  reserveOnHugePages(tree.leaf_vertices_, 9 * tree.triangle_order_.size() + kLanes);
  tree.leaf_vertices_.resize(9 * tree.triangle_order_.size() + kLanes);
  parallelFor(tree.nodes_.size(), threadCount(options.threads), [&](std::size_t node, std::size_t) {
    tree.writeLeafVertices(static_cast<std::uint32_t>(node));
  });

  BuildStats& stats = tree.stats_;
  stats.triangles = tree.mesh_->triangleCount();
  stats.nodes = tree.nodes_.size();
  stats.depth = writer.depth();
  stats.root_volume = tree.box(kRoot).volume();
  stats.bytes = tree.nodes_.size() * sizeof(Node) + tree.triangle_order_.size() * sizeof(std::uint32_t) +
                tree.leaf_vertices_.size() * sizeof(float);
  forEachChild(tree.nodes_, [&](Slot slot, Child child) {
    if (!child.isLeaf()) return;
    ++stats.leaves;
    stats.leaf_volume += tree.box(slot).volume();
  });
  return tree;
}

void ClusteredOctree::writeLeafVertices(std::uint32_t node) {
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const Child leaf = nodes_[node].children[lane];
    if (!leaf.isLeaf()) continue;
    const Obb frame = localBox({node, lane});
    float* row = leaf_vertices_.data() + 9 * std::size_t{leaf.first()};
    for (std::uint32_t i = 0; i < leaf.count(); ++i) {
      const Triangle triangle = mesh_->triangle(triangles(leaf)[i]);
      for (std::uint32_t v = 0; v < 3; ++v) {
        const Vec3 corner = frame.axes.transpose() * (triangle[v] - origin_ - frame.center);
        for (std::uint32_t k = 0; k < 3; ++k) {
          row[(3 * v + k) * leaf.count() + i] = static_cast<float>(corner[static_cast<Eigen::Index>(k)]);
        }
      }
    }
  }
}

Obb ClusteredOctree::localBox(Slot slot) const {
  const BoxF box = boxes(slot).get(static_cast<int>(slot.lane));
  return {box.center.cast<double>(), box.axes.cast<double>(), box.half_extents.cast<double>()};
}

Obb ClusteredOctree::box(Slot slot) const {
  Obb box = localBox(slot);
  box.center += origin_;
  return box;
}

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
      if (!nodes_[here.node()].children[lane].isEmpty()) open.push_back({{here.node(), lane}, level + 1});
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
      for (const std::uint32_t t : triangles(here)) {
        ++leaves_of_triangle[t];
        for (const Slot above : path) {
          const Obb bounds = localBox(above);
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
        if (!nodes_[here.node()].children[lane].isEmpty()) self(self, {here.node(), lane});
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
