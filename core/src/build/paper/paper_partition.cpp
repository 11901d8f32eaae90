#include "build/paper/paper_partition.h"

#include <algorithm>
#include <memory>

#include "build/box_fit.h"
#include "build/paper/octree.h"
#include "build/paper/principal_box.h"
#include "geometry/principal_axes.h"

namespace octoblisk::detail {
namespace {

/// A cell of the nested division: its triangles, or the cells into which it is divided.
struct Cell {
  TriangleSet triangles;
  std::vector<Cell> children;
};

/// A cell around up to eight cells. A single cell is returned unchanged.
Cell enclose(std::vector<Cell> children) {
  if (children.size() == 1) return std::move(children.front());
  return {{}, std::move(children)};
}

/// Groups consecutive cells into cells, level by level, until one is left.
Cell encloseMany(std::vector<Cell> cells) {
  while (cells.size() > kLanes) {
    std::vector<Cell> groups;
    for (std::size_t begin = 0; begin < cells.size(); begin += kLanes) {
      const auto from = cells.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto to = cells.begin() + static_cast<std::ptrdiff_t>(std::min(begin + kLanes, cells.size()));
      groups.push_back(enclose({std::make_move_iterator(from), std::make_move_iterator(to)}));
    }
    cells = std::move(groups);
  }
  return enclose(std::move(cells));
}

/// A leaf holds at most eight triangles. More than that (a large capacity, or duplicates at the depth limit)
/// become several leaves.
Cell leafCell(const TriangleSet& triangles) {
  std::vector<Cell> leaves;
  for (std::size_t begin = 0; begin < triangles.size(); begin += kLanes) {
    const auto from = triangles.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto to =
        triangles.begin() + static_cast<std::ptrdiff_t>(std::min(begin + kLanes, triangles.size()));
    leaves.push_back({TriangleSet(from, to), {}});
  }
  return encloseMany(std::move(leaves));
}

class PaperPartitioner {
 public:
  PaperPartitioner(std::span<const TriangleRecord> records, const PartClusterOptions& options)
      : options_(options) {
    centroids_.reserve(records.size());
    for (const TriangleRecord& record : records) centroids_.emplace_back(record.centroid.cast<double>());
  }

  Cell divide() const {
    std::vector<Cell> parts;
    for (const std::vector<TriangleSet>& part : partClusters(centroids_, options_)) {
      std::vector<Cell> cells;
      cells.reserve(part.size());
      for (const TriangleSet& cluster : part) cells.push_back(divideCluster(cluster));
      parts.push_back(enclose(std::move(cells)));
    }
    return encloseMany(std::move(parts));
  }

 private:
  Cell divideCluster(const TriangleSet& triangles) const {
    std::vector<Vec3> points;
    points.reserve(triangles.size());
    for (const std::uint32_t t : triangles) points.push_back(centroids_[t]);
    const Octree octree = Octree::build(
        points, {.leaf_capacity = options_.leaf_capacity, .axes = principalAxes(covariance(points))});
    return octreeCell(octree, octree.nodes().front(), triangles);
  }

  static Cell octreeCell(const Octree& octree, const Octree::Node& node, const TriangleSet& triangles) {
    if (node.isLeaf()) {
      TriangleSet leaf;
      for (std::uint32_t i = node.begin; i < node.end; ++i) leaf.push_back(triangles[octree.order()[i]]);
      return leafCell(leaf);
    }
    std::vector<Cell> children;
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      const Octree::Node& child = octree.nodes()[node.first_child + octant];
      if (child.count() > 0) children.push_back(octreeCell(octree, child, triangles));
    }
    return enclose(std::move(children));
  }

  const PartClusterOptions& options_;
  std::vector<Vec3> centroids_;
};

/// Stores the cells' triangles in sequence, and their nodes breadth first.
class Layout {
 public:
  Layout(std::span<const TriangleRecord> records, const Cell& root) : records_(records) {
    ordered_.reserve(records.size());
    partition_.nodes.emplace_back();
    place(root, 0);
    for (PartitionNode& node : partition_.nodes) {
      const std::span<const TriangleRecord> range(ordered_.data() + node.begin, node.count());
      sampleVertices(range, vertices_);
      node.box = enclosingBox(range, fitBox(vertices_, 0.0f).axes);
    }
  }

  Partition take() {
    for (const TriangleRecord& record : ordered_) partition_.order.push_back(record.triangle);
    return std::move(partition_);
  }

 private:
  void place(const Cell& cell, std::size_t index) {
    const auto begin = static_cast<std::uint32_t>(ordered_.size());
    const auto first_child = static_cast<std::uint32_t>(partition_.nodes.size());
    for (const std::uint32_t t : cell.triangles) ordered_.push_back(records_[t]);
    partition_.nodes.resize(partition_.nodes.size() + cell.children.size());
    for (std::size_t child = 0; child < cell.children.size(); ++child) {
      place(cell.children[child], first_child + child);
    }
    PartitionNode& node = partition_.nodes[index];
    node.begin = begin;
    node.end = static_cast<std::uint32_t>(ordered_.size());
    node.first_child = cell.children.empty() ? 0 : first_child;
    node.child_count = static_cast<std::uint32_t>(cell.children.size());
  }

  std::span<const TriangleRecord> records_;
  std::vector<TriangleRecord> ordered_;
  Partition partition_;
  VertexSample vertices_;
};

}  // namespace

Partition paperPartition(std::span<const TriangleRecord> records, const PartClusterOptions& options) {
  const Cell root = PaperPartitioner(records, options).divide();
  return std::make_unique<Layout>(records, root)->take();
}

}  // namespace octoblisk::detail
