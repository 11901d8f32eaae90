#include "build/node_divider.h"

#include <algorithm>

namespace octoblisk::detail {
namespace {

constexpr float kSlack = 0.1f;  // added to box edges, relative to the largest half extent of the node
// The number of triangles, in leaf capacities, up to which a node may consist of leaves only. A cluster of at
// most this size stays whole if its parent would otherwise create many nodes of two or three leaves. This
// saves a quarter of all nodes.
constexpr std::uint32_t kFullNode = 7;

/// The size up to which clusters are not divided further in a node of so many triangles.
std::uint32_t clusterGoal(std::size_t triangles, std::uint32_t capacity) {
  const std::uint32_t full = kFullNode * capacity;
  return triangles > full && triangles <= kLanes * full ? full : capacity;
}

}  // namespace

const std::vector<Cluster>& NodeDivider::byClusters(std::span<const TriangleRecord> records,
                                                    std::span<std::uint32_t> indices, const BoxF& box) {
  return divide(records, indices, box, Method::clusters);
}

const std::vector<Cluster>& NodeDivider::byMedians(std::span<const TriangleRecord> records,
                                                   std::span<std::uint32_t> indices, const BoxF& box) {
  return divide(records, indices, box, Method::medians);
}

const std::vector<Cluster>& NodeDivider::byPlanes(std::span<const TriangleRecord> records,
                                                  std::span<std::uint32_t> sample, const BoxF& box) {
  return divide(records, sample, box, Method::planes);
}

const std::vector<Cluster>& NodeDivider::divide(std::span<const TriangleRecord> records,
                                                std::span<std::uint32_t> indices, const BoxF& box,
                                                Method method) {
  records_ = records;
  indices_ = indices;
  slack_ = kSlack * box.half_extents.maxCoeff();
  cuts_.clear();
  clusters_.clear();
  clusters_.push_back({0, static_cast<std::uint32_t>(indices.size()), box});
  const std::uint32_t goal = method == Method::planes ? capacity_ : clusterGoal(indices.size(), capacity_);
  while (clusters_.size() < kLanes) {
    const auto extent = [&](const Cluster& cluster) {
      return cluster.count() <= goal ? -1.0f : cluster.box.half_extents.maxCoeff();
    };
    const auto widest = std::ranges::max_element(clusters_, {}, extent);
    if (extent(*widest) < 0.0f) break;
    const auto cluster = static_cast<std::size_t>(widest - clusters_.begin());
    if (method != Method::medians && cut(cluster)) continue;
    if (method == Method::planes) break;
    halve(cluster);
  }
  return clusters_;
}

bool NodeDivider::cut(std::size_t cluster) {
  const Cluster whole = clusters_[cluster];
  const std::span<std::uint32_t> indices = indices_.subspan(whole.begin, whole.count());
  const auto split = finder_.find(records_, indices, whole.box, slack_, effort_);
  if (!split) return false;
  const SplitFinder::Plane& plane = finder_.plane();
  const std::uint32_t low =
      finder_.sawAll() ? separate(indices, [&](std::size_t i) { return finder_.isLow(i); })
                       : separate(indices, [&](std::size_t i) { return plane.isLow(records_[indices[i]]); });
  if (low == 0 || low == whole.count()) return false;
  replace(cluster, whole.begin + low, split->low, split->high, finder_.sawAll());
  cuts_.push_back({cluster, plane});
  return true;
}

/// Halves a cluster at the median along its longest axis. Always makes progress.
void NodeDivider::halve(std::size_t cluster) {
  const Cluster whole = clusters_[cluster];
  const std::span<std::uint32_t> indices = indices_.subspan(whole.begin, whole.count());
  int longest = 0;
  whole.box.half_extents.maxCoeff(&longest);
  const Eigen::Vector3f axis = whole.box.axes.col(longest);
  const std::size_t half = indices.size() / 2;
  std::ranges::nth_element(indices, indices.begin() + static_cast<std::ptrdiff_t>(half), {},
                           [&](std::uint32_t index) {
                             return std::pair(axis.dot(records_[index].centroid), records_[index].triangle);
                           });
  replace(cluster, whole.begin + static_cast<std::uint32_t>(half), fitted(indices.first(half)),
          fitted(indices.subspan(half)), false);
}

void NodeDivider::replace(std::size_t cluster, std::uint32_t mid, const BoxF& low, const BoxF& high,
                          bool exact) {
  const Cluster whole = clusters_[cluster];
  clusters_[cluster] = {whole.begin, mid, low, exact};
  clusters_.insert(clusters_.begin() + static_cast<std::ptrdiff_t>(cluster) + 1,
                   Cluster{mid, whole.end, high, exact});
}

/// Moves the low indices before the others, keeping the order within each, and returns their number.
template <typename IsLow>
std::uint32_t NodeDivider::separate(std::span<std::uint32_t> indices, const IsLow& is_low) {
  high_.resize(std::max(high_.size(), indices.size()));
  std::size_t low = 0, high = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::uint32_t index = indices[i];
    const bool goes_low = is_low(i);
    indices[low] = high_[high] = index;
    low += goes_low;
    high += !goes_low;
  }
  std::copy_n(high_.begin(), high, indices.begin() + static_cast<std::ptrdiff_t>(low));
  return static_cast<std::uint32_t>(low);
}

BoxF NodeDivider::fitted(std::span<const std::uint32_t> indices) {
  sampleVertices(records_, indices, vertices_);
  return fitBox(vertices_, slack_);
}

}  // namespace octoblisk::detail
