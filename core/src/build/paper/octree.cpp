#include "build/paper/octree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "geometry/bounding_box.h"

namespace octoblisk::detail {
namespace {

int octantOf(const Vec3& point, const Vec3& center) {
  return (point.x() >= center.x()) | (point.y() >= center.y()) << 1 | (point.z() >= center.z()) << 2;
}

Vec3 octantCenter(const Octree::Node& node, int octant) {
  const Vec3 side(octant & 1 ? 1.0 : -1.0, octant & 2 ? 1.0 : -1.0, octant & 4 ? 1.0 : -1.0);
  return node.center + 0.5 * side.cwiseProduct(node.half_extents);
}

OctreeStats measure(const std::vector<Octree::Node>& nodes) {
  OctreeStats stats;
  stats.total_nodes = nodes.size();
  stats.root_volume = 8.0 * nodes.front().half_extents.prod();
  for (const Octree::Node& node : nodes) {
    stats.depth = std::max(stats.depth, node.depth);
    if (!node.isLeaf() || node.count() == 0) continue;
    ++stats.non_empty_leaves;
    stats.leaf_volume += 8.0 * node.half_extents.prod();
  }
  return stats;
}

}  // namespace

Octree Octree::build(std::span<const Vec3> points, const OctreeOptions& options) {
  if (points.empty()) throw std::invalid_argument("an octree needs at least one point");
  if (options.leaf_capacity < 1) throw std::invalid_argument("the octree's leaf capacity must be at least 1");
  if (points.size() >= std::numeric_limits<std::uint32_t>::max() / 8) {
    throw std::invalid_argument("the octree holds at most 2^29 - 2 points");
  }

  Octree octree;
  octree.axes_ = options.axes;
  std::vector<Vec3> local(points.size());
  std::ranges::transform(points, local.begin(),
                         [&](const Vec3& point) -> Vec3 { return options.axes.transpose() * point; });
  octree.order_.resize(points.size());
  std::iota(octree.order_.begin(), octree.order_.end(), 0u);

  const Obb box = boundingBox(local, Mat3::Identity());
  Node root{box.center, box.half_extents, 0, static_cast<std::uint32_t>(points.size()), 0, 0};
  if (options.cubic) root.half_extents.setConstant(root.half_extents.maxCoeff());
  octree.nodes_.push_back(root);

  std::vector<std::uint32_t> sorted;
  for (std::size_t n = 0; n < octree.nodes_.size(); ++n) {  // breadth first: children are appended
    const Node node = octree.nodes_[n];
    if (node.count() <= options.leaf_capacity || node.depth >= kMaxDepth) continue;

    const std::span<std::uint32_t> range(octree.order_.data() + node.begin, node.count());
    std::array<std::uint32_t, 9> start{};  // counting sort by octant, stable
    for (const std::uint32_t point : range)
      ++start[static_cast<std::size_t>(octantOf(local[point], node.center)) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::array<std::uint32_t, 8> next;
    std::copy_n(start.begin(), 8, next.begin());
    sorted.resize(range.size());
    for (const std::uint32_t point : range) {
      sorted[next[static_cast<std::size_t>(octantOf(local[point], node.center))]++] = point;
    }
    std::ranges::copy(sorted, range.begin());

    octree.nodes_[n].first_child = static_cast<std::uint32_t>(octree.nodes_.size());
    for (int octant = 0; octant < 8; ++octant) {
      const auto o = static_cast<std::size_t>(octant);
      octree.nodes_.push_back({octantCenter(node, octant), 0.5 * node.half_extents, node.begin + start[o],
                               node.begin + start[o + 1], 0, node.depth + 1});
    }
  }
  octree.stats_ = measure(octree.nodes_);
  return octree;
}

}  // namespace octoblisk::detail
