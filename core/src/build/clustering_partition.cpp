// Recursive clustering: every node is divided by k-means bisections in position–normal space
// (node_divider.h).
//
// Large nodes are divided level by level: a sample determines the planes, then all triangles are sorted by
// them. The others are subtrees, each divided by one thread. How a node is divided depends only on its
// triangles, so the partition does not depend on the number of threads.
#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "build/node_divider.h"
#include "build/partition.h"

namespace octoblisk::detail {
namespace {

using Eight = Eigen::Array<float, kLanes, 1>;

constexpr int kClusteringDepth = 32;        // deeper nodes are halved at the median, which bounds the depth
constexpr std::uint32_t kSubtree = 4096;    // the most triangles of a subtree that one thread divides
constexpr std::size_t kLargeSample = 4096;  // the most triangles that determine the planes of a larger node
constexpr std::size_t kChunk = 8192;        // triangles that a thread sorts at a time

SplitEffort effortOf(BuildQuality quality) {
  if (quality == BuildQuality::high) return {};
  return {.samples = 128, .lloyd_steps = 3, .axis_seeds = 1, .one_seed_below = 24, .refine_turn = false};
}

using Nodes = std::vector<PartitionNode>;

/// A node that is not divided yet. Its records are in one of two buffers.
struct Open {
  std::uint32_t node;
  int depth;
  int buffer;
};

/// Finds which of up to eight clusters a record belongs to, from the cuts that made the clusters.
class ClusterClassifier {
 public:
  explicit ClusterClassifier(const std::vector<Cut>& cuts) : cluster_count_(cuts.size() + 1) {
    for (std::size_t c = 0; c < cuts.size(); ++c) {
      const auto lane = static_cast<Eigen::Index>(c);
      for (int k = 0; k < 3; ++k) {
        normals_[static_cast<std::size_t>(k)][lane] = cuts[c].plane.of_centroid[k];
        normals_[static_cast<std::size_t>(k) + 3][lane] = cuts[c].plane.of_normal[k];
      }
      offsets_[lane] = cuts[c].plane.offset;
    }
    for (unsigned sides = 0; sides < clusters_.size(); ++sides) {
      std::size_t cluster = 0;
      for (std::size_t c = 0; c < cuts.size(); ++c) {
        const bool is_low = (sides >> c & 1u) != 0;
        if (cluster > cuts[c].cluster || (cluster == cuts[c].cluster && !is_low)) ++cluster;
      }
      clusters_[sides] = static_cast<std::uint8_t>(cluster);
    }
  }

  std::size_t clusterCount() const { return cluster_count_; }

  std::uint8_t operator()(const TriangleRecord& record) const {
    Eight height = normals_[0] * record.centroid[0];
    height += normals_[1] * record.centroid[1];
    height += normals_[2] * record.centroid[2];
    for (int k = 0; k < 3; ++k) height += normals_[static_cast<std::size_t>(k) + 3] * record.normal[k];
    unsigned sides = 0;
    for (int c = 0; c < kLanes - 1; ++c) sides |= static_cast<unsigned>(height[c] < offsets_[c]) << c;
    return clusters_[sides];
  }

 private:
  std::size_t cluster_count_;
  std::array<Eight, 6> normals_ = {Eight::Zero(), Eight::Zero(), Eight::Zero(),
                                   Eight::Zero(), Eight::Zero(), Eight::Zero()};
  Eight offsets_ = Eight::Zero();
  std::array<std::uint8_t, 1u << (kLanes - 1)> clusters_;
};

class ClusteringPartitioner {
 public:
  ClusteringPartitioner(TriangleRecords records, const BuildOptions& options)
      : capacity_(static_cast<std::uint32_t>(options.leaf_capacity)) {
    const std::size_t useful_threads = std::min<std::size_t>(
        static_cast<std::size_t>(threadCount(options.threads)), records.size() / kSubtree + 1);
    threads_ = static_cast<int>(useful_threads);
    for (std::size_t i = 0; i < useful_threads; ++i) {
      dividers_.push_back(std::make_unique<NodeDivider>(capacity_, effortOf(options.quality)));
    }
    order_.resize(records.size());
    buffers_[0] = std::move(records);
    if (order_.size() > kSubtree) buffers_[1] = TriangleRecords(order_.size());
  }

  Partition run() {
    const auto sample = std::make_unique<VertexSample>();
    sampleVertices(buffers_[0].span(), *sample);
    const BoxF box = enclosingBox(buffers_[0].span(), fitBox(*sample, 0.0f).axes, threads_);
    nodes_.push_back({0, static_cast<std::uint32_t>(order_.size()), 0, 0, box});
    divideSubtrees(divideLargeNodes());
    return {std::move(order_), std::move(nodes_)};
  }

 private:
  std::span<TriangleRecord> recordsOf(int buffer, const PartitionNode& node) {
    return buffers_[static_cast<std::size_t>(buffer)].span().subspan(node.begin, node.count());
  }

  /// Returns the nodes that remain to be divided.
  std::vector<Open> divideLargeNodes() {
    std::vector<Open> level = {{0, 0, 0}}, left;
    while (!level.empty()) {
      std::vector<Open> large;
      for (const Open& open : level) {
        const bool is_large = nodes_[open.node].count() > kSubtree && open.depth < kClusteringDepth;
        (is_large ? large : left).push_back(open);
      }
      std::vector<Nodes> children(large.size());
      const bool one_by_one = large.size() < static_cast<std::size_t>(threads_);
      parallelFor(large.size(), one_by_one ? 1 : threads_, [&](std::size_t i, std::size_t worker) {
        children[i] = divideLarge(nodes_[large[i].node], large[i].buffer, *dividers_[worker],
                                  one_by_one ? threads_ : 1);
      });
      level.clear();
      for (std::size_t i = 0; i < large.size(); ++i) {
        const Open& open = large[i];
        if (children[i].empty()) {
          left.push_back(open);
          continue;
        }
        adopt(nodes_, open.node, children[i]);
        for (std::uint32_t c = 0; c < children[i].size(); ++c) {
          level.push_back({nodes_[open.node].first_child + c, open.depth + 1, 1 - open.buffer});
        }
      }
    }
    return left;
  }

  /// Moves the node's records to the other buffer, cluster by cluster, and returns its children. Returns none
  /// and moves nothing if no plane divides the records.
  Nodes divideLarge(const PartitionNode& node, int buffer, NodeDivider& divider, int threads) {
    const std::span<const TriangleRecord> records = recordsOf(buffer, node);
    std::vector<std::uint32_t> sample;
    const std::size_t stride = (records.size() + kLargeSample - 1) / kLargeSample;
    for (std::size_t i = 0; i < records.size(); i += stride) sample.push_back(static_cast<std::uint32_t>(i));
    const std::vector<Cluster>& clusters = divider.byPlanes(records, sample, node.box);

    const ClusterClassifier classifier(divider.cuts());
    std::vector<std::uint8_t> cluster_of(records.size());
    // For each chunk first counts, then the next free places.
    std::vector<std::array<std::uint32_t, kLanes>> places((records.size() + kChunk - 1) / kChunk);
    parallelForChunks(records.size(), kChunk, threads, [&](std::size_t begin, std::size_t end) {
      std::array<std::uint32_t, kLanes> counts = {};
      for (std::size_t i = begin; i < end; ++i) ++counts[cluster_of[i] = classifier(records[i])];
      places[begin / kChunk] = counts;
    });

    Nodes children;
    std::uint32_t place = 0;
    for (std::size_t c = 0; c < classifier.clusterCount(); ++c) {
      const std::uint32_t begin = place;
      for (auto& chunk : places) place += std::exchange(chunk[c], place);
      if (place == begin) continue;  // rounding has put its few sampled triangles on the other side
      children.push_back({node.begin + begin, node.begin + place, 0, 0, clusters[c].box});
    }
    if (children.size() < 2) return {};

    const std::span<TriangleRecord> moved = recordsOf(1 - buffer, node);
    parallelForChunks(records.size(), kChunk, threads, [&](std::size_t begin, std::size_t end) {
      std::array<std::uint32_t, kLanes> next = places[begin / kChunk];
      for (std::size_t i = begin; i < end; ++i) moved[next[cluster_of[i]]++] = records[i];
    });
    for (PartitionNode& child : children) {
      child.box = enclosingBox(recordsOf(1 - buffer, child), child.box.axes, threads);
    }
    return children;
  }

  void divideSubtrees(const std::vector<Open>& roots) {
    std::vector<Nodes> subtrees(roots.size());
    parallelFor(roots.size(), threads_, [&](std::size_t i, std::size_t worker) {
      const PartitionNode& root = nodes_[roots[i].node];
      const std::span<const TriangleRecord> records = recordsOf(roots[i].buffer, root);
      const std::span<std::uint32_t> order = std::span(order_).subspan(root.begin, root.count());
      std::iota(order.begin(), order.end(), 0u);
      subtrees[i] = {root};
      divideSubtree(subtrees[i], 0, roots[i].depth, records, order, *dividers_[worker]);
      for (std::uint32_t& index : order) index = records[index].triangle;
    });
    for (std::size_t i = 0; i < roots.size(); ++i) graft(roots[i].node, subtrees[i]);
  }

  /// Divides a node and everything below it. The order refers to the records of the subtree's root,
  /// nodes.front().
  void divideSubtree(Nodes& nodes, std::uint32_t index, int depth, std::span<const TriangleRecord> records,
                     std::span<std::uint32_t> order, NodeDivider& divider) const {
    const PartitionNode node = nodes[index];
    if (node.count() <= capacity_) return;
    const std::uint32_t begin = nodes.front().begin;
    const std::span<std::uint32_t> indices = order.subspan(node.begin - begin, node.count());
    const std::vector<Cluster>& clusters = depth < kClusteringDepth
                                               ? divider.byClusters(records, indices, node.box)
                                               : divider.byMedians(records, indices, node.box);
    Nodes children;
    children.reserve(clusters.size());
    for (const Cluster& cluster : clusters) {
      const BoxF box = cluster.exact ? cluster.box
                                     : enclosingBox(records, indices.subspan(cluster.begin, cluster.count()),
                                                    cluster.box.axes);
      children.push_back({node.begin + cluster.begin, node.begin + cluster.end, 0, 0, box});
    }
    adopt(nodes, index, children);
    for (std::uint32_t c = 0; c < children.size(); ++c) {
      divideSubtree(nodes, nodes[index].first_child + c, depth + 1, records, order, divider);
    }
  }

  static void adopt(Nodes& nodes, std::uint32_t parent, const Nodes& children) {
    nodes[parent].first_child = static_cast<std::uint32_t>(nodes.size());
    nodes[parent].child_count = static_cast<std::uint32_t>(children.size());
    nodes.insert(nodes.end(), children.begin(), children.end());
  }

  /// Appends a subtree, whose first node already exists.
  void graft(std::uint32_t root, const Nodes& subtree) {
    const auto shift = static_cast<std::uint32_t>(nodes_.size()) - 1;
    const auto shifted = [&](PartitionNode node) {
      if (node.child_count > 0) node.first_child += shift;
      return node;
    };
    nodes_[root] = shifted(subtree.front());
    std::transform(subtree.begin() + 1, subtree.end(), std::back_inserter(nodes_), shifted);
  }

  const std::uint32_t capacity_;
  int threads_ = 1;
  std::vector<std::unique_ptr<NodeDivider>> dividers_;  // one per thread
  std::array<TriangleRecords, 2> buffers_;
  std::vector<std::uint32_t> order_;
  Nodes nodes_;
};

}  // namespace

Partition clusteringPartition(TriangleRecords records, const BuildOptions& options) {
  return ClusteringPartitioner(std::move(records), options).run();
}

}  // namespace octoblisk::detail
