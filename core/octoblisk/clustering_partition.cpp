// Recursive clustering: every node is divided by k-means bisections in position–normal space, where among
// several seeds the one with the smallest boxes round its two sides wins (split_finder.h).
//
// Large nodes are divided level by level, the rest as subtrees, each by one thread. What is divided how
// depends on the triangles alone, so that the result does not depend on the number of threads.
#include <algorithm>
#include <memory>
#include <span>

#include "octoblisk/box_fit.h"
#include "octoblisk/parallel.h"
#include "octoblisk/partition.h"
#include "octoblisk/split_finder.h"

namespace octoblisk {
namespace {

constexpr float kSlack = 0.1f;        // added to box edges, in largest half extents of the node
constexpr int kClusteringDepth = 32;  // below it halves by the median, so that the depth stays bounded

constexpr std::uint32_t kSubtree = 4096;  // triangles of the largest subtree that is one thread's
constexpr std::size_t kChunk = 8192;      // triangles that a thread moves or bounds at a time

SplitEffort effortOf(BuildQuality quality) {
  if (quality == BuildQuality::fast)
    return {.samples = 128, .lloyd_steps = 3, .seeds = 2, .refine_turn = false};
  return {};
}

struct Range {
  std::uint32_t begin, end;
  BoxF box;            // its frame counts; its extents are approximate unless exact
  bool exact = false;  // the box holds all vertices

  std::uint32_t count() const { return end - begin; }
};

/// A node that is not divided yet.
struct Open {
  std::uint32_t node;
  int depth;
};

/// What a thread needs to divide nodes.
struct Workspace {
  SplitFinder finder;
  VertexSample vertices;
  std::vector<TriangleRecord> moved;
};

/// Divides single nodes; threads > 1 help with moving and bounding the triangles of large ones.
class NodeDivider {
 public:
  NodeDivider(std::span<TriangleRecord> records, std::uint32_t capacity, const SplitEffort& effort,
              Workspace& workspace, int threads)
      : records_(records), capacity_(capacity), effort_(effort), work_(workspace), threads_(threads) {}

  bool isLeaf(const PartitionNode& node) const { return node.count() <= capacity_; }

  std::vector<PartitionNode> children(const PartitionNode& node, int depth) {
    slack_ = kSlack * node.box.half_extents.maxCoeff();
    std::vector<Range> ranges = {{node.begin, node.end, node.box}};
    ranges.reserve(kLanes);
    while (ranges.size() < kLanes) {
      const auto widest = widestDivisible(ranges);
      if (widest == ranges.end()) break;
      const auto [low, high] = bisect(*widest, depth < kClusteringDepth);
      *widest = low;
      ranges.insert(widest + 1, high);
    }
    std::vector<PartitionNode> children;
    children.reserve(ranges.size());
    for (const Range& range : ranges) {
      children.push_back({range.begin, range.end, 0, 0, range.exact ? range.box : enclosing(range)});
    }
    return children;
  }

  /// The node and all below it, in the order of Partition::nodes, counted from 0.
  std::vector<PartitionNode> subtree(const PartitionNode& root, int depth) {
    std::vector<PartitionNode> nodes = {root};
    divideAll(nodes, {0, depth});
    return nodes;
  }

 private:
  std::span<TriangleRecord> triangles(const Range& range) const {
    return records_.subspan(range.begin, range.count());
  }

  void divideAll(std::vector<PartitionNode>& nodes, Open open) {
    if (isLeaf(nodes[open.node])) return;
    const std::vector<PartitionNode> parts = children(nodes[open.node], open.depth);
    const auto first_child = static_cast<std::uint32_t>(nodes.size());
    const auto child_count = static_cast<std::uint32_t>(parts.size());
    nodes[open.node].first_child = first_child;
    nodes[open.node].child_count = child_count;
    nodes.insert(nodes.end(), parts.begin(), parts.end());
    for (std::uint32_t child = 0; child < child_count; ++child) {
      divideAll(nodes, {first_child + child, open.depth + 1});
    }
  }

  std::vector<Range>::iterator widestDivisible(std::vector<Range>& ranges) const {
    const auto extent = [&](const Range& range) {
      return range.count() <= capacity_ ? -1.0f : range.box.half_extents.maxCoeff();
    };
    const auto widest = std::ranges::max_element(ranges, {}, extent);
    return extent(*widest) < 0.0f ? ranges.end() : widest;
  }

  std::pair<Range, Range> bisect(const Range& range, bool by_clusters) {
    if (by_clusters) {
      SplitFinder& finder = work_.finder;
      if (const auto split = finder.find(triangles(range), range.box, slack_, effort_)) {
        const SplitFinder::Plane& plane = finder.plane();
        const std::uint32_t mid =
            range.begin + (finder.sawAll()
                               ? separate(triangles(range), [&](std::size_t i) { return finder.isLow(i); })
                               : separate(triangles(range), [&](std::size_t i) {
                                   return plane.isLow(records_[range.begin + i]);
                                 }));
        if (mid > range.begin && mid < range.end) {
          return {{range.begin, mid, split->low, finder.sawAll()},
                  {mid, range.end, split->high, finder.sawAll()}};
        }
      }
    }
    return halve(range);
  }

  /// Puts the low records before the others, each in the order they are in, and returns their number.
  template <typename IsLow>
  std::uint32_t separate(std::span<TriangleRecord> records, const IsLow& is_low) {
    std::vector<TriangleRecord>& moved = work_.moved;
    moved.resize(std::max(moved.size(), records.size()));
    if (threads_ == 1 || records.size() < 2 * kChunk) {
      std::size_t low = 0, high = 0;
      for (std::size_t i = 0; i < records.size(); ++i) {
        const TriangleRecord record = records[i];
        const bool goes_low = is_low(i);
        records[low] = record;
        moved[high] = record;
        low += goes_low;
        high += !goes_low;
      }
      std::copy_n(moved.begin(), high, records.begin() + static_cast<std::ptrdiff_t>(low));
      return static_cast<std::uint32_t>(low);
    }
    const std::size_t chunks = (records.size() + kChunk - 1) / kChunk;
    const auto chunkEnd = [&](std::size_t chunk) { return std::min(records.size(), (chunk + 1) * kChunk); };
    std::vector<char> goes_low(records.size());
    std::vector<std::size_t> lows(chunks + 1);
    parallelFor(chunks, threads_, [&](std::size_t chunk, std::size_t) {
      std::size_t low = 0;
      for (std::size_t i = chunk * kChunk; i < chunkEnd(chunk); ++i) low += goes_low[i] = is_low(i);
      lows[chunk + 1] = low;
    });
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) lows[chunk + 1] += lows[chunk];
    const std::size_t all_low = lows.back();
    parallelFor(chunks, threads_, [&](std::size_t chunk, std::size_t) {
      std::size_t low = lows[chunk], high = all_low + chunk * kChunk - low;
      for (std::size_t i = chunk * kChunk; i < chunkEnd(chunk); ++i)
        moved[goes_low[i] ? low++ : high++] = records[i];
    });
    parallelFor(chunks, threads_, [&](std::size_t chunk, std::size_t) {
      const std::size_t begin = chunk * kChunk;
      std::copy(moved.begin() + static_cast<std::ptrdiff_t>(begin),
                moved.begin() + static_cast<std::ptrdiff_t>(chunkEnd(chunk)),
                records.begin() + static_cast<std::ptrdiff_t>(begin));
    });
    return static_cast<std::uint32_t>(all_low);
  }

  /// By the median along the longest axis; always makes progress.
  std::pair<Range, Range> halve(const Range& range) {
    int longest = 0;
    range.box.half_extents.maxCoeff(&longest);
    const Eigen::Vector3f axis = range.box.axes.col(longest);
    const std::span<TriangleRecord> all = triangles(range);
    const auto half = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::ranges::nth_element(all, half, {}, [&](const TriangleRecord& record) {
      return std::pair(axis.dot(record.centroid), record.triangle);
    });
    const std::uint32_t mid = range.begin + range.count() / 2;
    const auto fitted = [&](std::uint32_t begin, std::uint32_t end) {
      sampleVertices(records_.subspan(begin, end - begin), work_.vertices);
      return Range{begin, end, fitBox(work_.vertices, slack_)};
    };
    return {fitted(range.begin, mid), fitted(mid, range.end)};
  }

  BoxF enclosing(const Range& range) const {
    return enclosingBox(triangles(range), range.box.axes, threads_);
  }

  const std::span<TriangleRecord> records_;
  const std::uint32_t capacity_;
  const SplitEffort effort_;
  Workspace& work_;
  const int threads_;
  float slack_ = 0.0f;
};

/// Appends a subtree, whose first node is there already.
void append(const std::vector<PartitionNode>& subtree, std::uint32_t root,
            std::vector<PartitionNode>& nodes) {
  const auto shift = static_cast<std::uint32_t>(nodes.size()) - 1;
  const auto shifted = [&](PartitionNode node) {
    if (node.child_count > 0) node.first_child += shift;
    return node;
  };
  nodes[root] = shifted(subtree.front());
  for (std::size_t i = 1; i < subtree.size(); ++i) nodes.push_back(shifted(subtree[i]));
}

}  // namespace

Partition clusteringPartition(std::vector<TriangleRecord> records, const ClusteringOptions& options) {
  const std::span<TriangleRecord> all = records;
  const auto capacity = static_cast<std::uint32_t>(options.leaf_capacity);
  const SplitEffort effort = effortOf(options.quality);
  std::vector<std::unique_ptr<Workspace>> workspaces;
  const std::size_t useful_threads =
      std::min(static_cast<std::size_t>(options.threads), records.size() / kSubtree + 1);
  for (std::size_t i = 0; i < useful_threads; ++i) workspaces.push_back(std::make_unique<Workspace>());
  const auto threads = static_cast<int>(useful_threads);
  const auto dividerOf = [&](std::size_t worker, int helpers) {
    return NodeDivider(all, capacity, effort, *workspaces[worker], helpers);
  };

  Partition partition;
  std::vector<PartitionNode>& nodes = partition.nodes;
  sampleVertices(all, workspaces.front()->vertices);
  const BoxF box = enclosingBox(all, fitBox(workspaces.front()->vertices, 0.0f).axes, threads);
  nodes.push_back({0, static_cast<std::uint32_t>(records.size()), 0, 0, box});

  std::vector<Open> level = {{0, 0}}, roots;
  while (!level.empty()) {
    const auto is_large = [&](const Open& open) { return nodes[open.node].count() > kSubtree; };
    const auto small = std::ranges::stable_partition(level, is_large);
    roots.insert(roots.end(), small.begin(), small.end());
    level.erase(small.begin(), small.end());
    std::vector<std::vector<PartitionNode>> parts(level.size());
    const bool together = level.size() < useful_threads;  // all threads at each node in turn
    parallelFor(level.size(), together ? 1 : threads, [&](std::size_t i, std::size_t worker) {
      parts[i] = dividerOf(worker, together ? threads : 1).children(nodes[level[i].node], level[i].depth);
    });
    std::vector<Open> next;
    for (std::size_t i = 0; i < level.size(); ++i) {
      PartitionNode& parent = nodes[level[i].node];
      parent.first_child = static_cast<std::uint32_t>(nodes.size());
      parent.child_count = static_cast<std::uint32_t>(parts[i].size());
      for (const PartitionNode& child : parts[i]) {
        next.push_back({static_cast<std::uint32_t>(nodes.size()), level[i].depth + 1});
        nodes.push_back(child);
      }
    }
    level = std::move(next);
  }

  std::vector<std::vector<PartitionNode>> subtrees(roots.size());
  parallelFor(roots.size(), threads, [&](std::size_t i, std::size_t worker) {
    subtrees[i] = dividerOf(worker, 1).subtree(nodes[roots[i].node], roots[i].depth);
  });
  for (std::size_t i = 0; i < roots.size(); ++i) append(subtrees[i], roots[i].node, nodes);
  partition.records = std::move(records);
  return partition;
}

}  // namespace octoblisk
