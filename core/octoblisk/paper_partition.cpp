// The paper's partition: parts → k clusters → octree in each cluster's principal frame → leaf ranges.
#include <algorithm>
#include <map>
#include <memory>
#include <numeric>

#include "octoblisk/box_fit.h"
#include "octoblisk/k_means.h"
#include "octoblisk/obb.h"
#include "octoblisk/octree.h"
#include "octoblisk/partition.h"

namespace octoblisk {
namespace {

using TriangleSet = std::vector<std::uint32_t>;  // indices of records

/// A cell of the nested division: its triangles, or the cells it is divided into.
struct Cell {
  TriangleSet triangles;
  std::vector<Cell> children;
};

/// A cell round up to eight cells; one cell alone stays as it is.
Cell enclose(std::vector<Cell> children) {
  if (children.size() == 1) return std::move(children.front());
  return {{}, std::move(children)};
}

/// Cells round consecutive cells, level by level, until one is left.
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

/// At most eight triangles fit a leaf: more (a large capacity, or duplicates at the depth cap) become
/// several.
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
  PaperPartitioner(std::span<const TriangleRecord> records, const PaperPartitionOptions& options)
      : options_(options) {
    centroids_.reserve(records.size());
    for (const TriangleRecord& record : records) centroids_.push_back(record.centroid.cast<double>());
  }

  Cell divide() const {
    std::map<int, TriangleSet> parts;
    for (std::uint32_t t = 0; t < centroids_.size(); ++t) {
      parts[options_.part_of_triangle.empty() ? 0 : options_.part_of_triangle[t]].push_back(t);
    }
    std::vector<Cell> cells;
    for (const auto& [part, triangles] : parts) cells.push_back(dividePart(triangles));
    return encloseMany(std::move(cells));
  }

 private:
  std::vector<Vec3> centroidsOf(const TriangleSet& triangles) const {
    std::vector<Vec3> points;
    points.reserve(triangles.size());
    for (const std::uint32_t t : triangles) points.push_back(centroids_[t]);
    return points;
  }

  Cell dividePart(const TriangleSet& triangles) const {
    const std::size_t k = std::min(options_.clusters, triangles.size());
    const Clustering clustering = kMeans(centroidsOf(triangles), {.k = k, .seed = options_.seed});
    std::vector<TriangleSet> clusters(k);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      clusters[clustering.cluster_of_point[i]].push_back(triangles[i]);
    }
    std::erase_if(clusters, [](const TriangleSet& cluster) { return cluster.empty(); });
    std::vector<Cell> cells;
    for (const TriangleSet& cluster : clusters) cells.push_back(divideCluster(cluster));
    return enclose(std::move(cells));
  }

  Cell divideCluster(const TriangleSet& triangles) const {
    const std::vector<Vec3> points = centroidsOf(triangles);
    const Octree octree =
        Octree::build(points, {.leaf_capacity = static_cast<std::size_t>(options_.leaf_capacity),
                               .axes = principalAxes(covariance(points))});
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

  const PaperPartitionOptions& options_;
  std::vector<Vec3> centroids_;
};

/// Lays the cells' triangles out one after the other, and their nodes breadth first.
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

Partition paperPartition(std::span<const TriangleRecord> records, const PaperPartitionOptions& options) {
  const Cell root = PaperPartitioner(records, options).divide();
  return std::make_unique<Layout>(records, root)->take();
}

}  // namespace octoblisk
