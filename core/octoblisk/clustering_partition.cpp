// Recursive clustering: every node is divided by k-means bisections in position–normal space, where among
// several seeds the one with the smallest boxes round its two sides wins.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "octoblisk/box_fit.h"
#include "octoblisk/partition.h"

namespace octoblisk {
namespace {

constexpr int kLloydSteps = 8;
constexpr float kNormalWeight = 0.25f;  // of a unit normal, in largest half extents
constexpr float kSlack = 0.1f;          // added to box edges, in largest half extents of the node
constexpr float kThinAxis = 0.25f;      // axes shorter than this part of the longest are no seeds
constexpr float kSameError = 2e-6f;     // relative: two seeds that end here have found the same clusters
constexpr float kSettled = 1e-6f;       // relative: a plane that moves less has settled
constexpr int kClusteringDepth = 32;    // below it halves by the median, so that the depth stays bounded

using Feature = Eigen::Matrix<float, 6, 1>;
using FeatureSample = Eigen::Matrix<float, Eigen::Dynamic, 6, Eigen::ColMajor, kSampledTriangles, 6>;
using Side = Eigen::Matrix<float, Eigen::Dynamic, 1, Eigen::ColMajor, kSampledTriangles, 1>;

/// Divides six-dimensional features f into normal·f < offset and the rest.
struct Plane {
  Feature normal;
  float offset = 0.0f;
};

struct Range {
  std::uint32_t begin, end;
  BoxF box;  // round a sample: its frame counts, its extents are approximate

  std::uint32_t count() const { return end - begin; }
};

class ClusteringPartitioner {
 public:
  ClusteringPartitioner(std::vector<TriangleRecord> records, int leaf_capacity)
      : capacity_(static_cast<std::uint32_t>(leaf_capacity)) {
    partition_.records = std::move(records);
  }

  Partition run() {
    sampleVertices(partition_.records, vertices_);
    const BoxF box = enclosingBox(partition_.records, fitBox(vertices_, 0.0f).axes);
    partition_.nodes.push_back({0, static_cast<std::uint32_t>(partition_.records.size()), 0, 0, box});
    divide(0, 0);
    return std::move(partition_);
  }

 private:
  std::span<TriangleRecord> records(std::uint32_t begin, std::uint32_t end) {
    return {partition_.records.data() + begin, end - begin};
  }

  void divide(std::uint32_t node_index, int depth) {
    const PartitionNode node = partition_.nodes[node_index];
    if (node.count() <= capacity_) return;
    slack_ = kSlack * node.box.half_extents.maxCoeff();
    std::vector<Range> ranges = {{node.begin, node.end, node.box}};
    while (ranges.size() < kLanes) {
      const auto widest = widestDivisible(ranges);
      if (widest == ranges.end()) break;
      const auto [low, high] = bisect(*widest, depth < kClusteringDepth);
      *widest = low;
      ranges.insert(widest + 1, high);
    }
    const auto first_child = static_cast<std::uint32_t>(partition_.nodes.size());
    partition_.nodes[node_index].first_child = first_child;
    partition_.nodes[node_index].child_count = static_cast<std::uint32_t>(ranges.size());
    for (const Range& range : ranges) {
      const BoxF box = enclosingBox(records(range.begin, range.end), range.box.axes);
      partition_.nodes.push_back({range.begin, range.end, 0, 0, box});
    }
    for (std::uint32_t child = 0; child < ranges.size(); ++child) divide(first_child + child, depth + 1);
  }

  std::vector<Range>::iterator widestDivisible(std::vector<Range>& ranges) const {
    const auto extent = [&](const Range& range) {
      return range.count() <= capacity_ ? -1.0f : range.box.half_extents.maxCoeff();
    };
    const auto widest = std::ranges::max_element(ranges, {}, extent);
    return extent(*widest) < 0.0f ? ranges.end() : widest;
  }

  std::pair<Range, Range> bisect(const Range& range, bool by_clusters) {
    const std::span<TriangleRecord> triangles = records(range.begin, range.end);
    if (by_clusters) {
      sampleFeatures(triangles, range.box);
      if (const std::optional<Split> split = bestSplit(range.box)) {
        const float normal_weight = normalWeight(range.box);
        const auto middle =
            std::partition(triangles.begin(), triangles.end(), [&](const TriangleRecord& record) {
              return split->plane.normal.dot(featureOf(record, range.box.center, normal_weight)) <
                     split->plane.offset;
            });
        const auto mid = range.begin + static_cast<std::uint32_t>(middle - triangles.begin());
        if (mid > range.begin && mid < range.end) {
          return {{range.begin, mid, split->low}, {mid, range.end, split->high}};
        }
      }
    }
    return halve(range);
  }

  /// By the median along the longest axis; always makes progress.
  std::pair<Range, Range> halve(const Range& range) {
    const std::span<TriangleRecord> triangles = records(range.begin, range.end);
    int longest = 0;
    range.box.half_extents.maxCoeff(&longest);
    const Eigen::Vector3f axis = range.box.axes.col(longest);
    const auto half = triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2);
    std::ranges::nth_element(triangles, half, {}, [&](const TriangleRecord& record) {
      return std::pair(axis.dot(record.centroid), record.triangle);
    });
    const std::uint32_t mid = range.begin + range.count() / 2;
    const auto sampled = [&](std::uint32_t begin, std::uint32_t end) {
      sampleVertices(records(begin, end), vertices_);
      return Range{begin, end, fitBox(vertices_, slack_)};
    };
    return {sampled(range.begin, mid), sampled(mid, range.end)};
  }

  static float normalWeight(const BoxF& box) { return kNormalWeight * box.half_extents.maxCoeff(); }

  static Feature featureOf(const TriangleRecord& record, const Eigen::Vector3f& center, float normal_weight) {
    Feature feature;
    feature << record.centroid - center, normal_weight * record.normal;
    return feature;
  }

  void sampleFeatures(std::span<const TriangleRecord> triangles, const BoxF& box) {
    const std::size_t stride = (triangles.size() + kSampledTriangles - 1) / kSampledTriangles;
    const float normal_weight = normalWeight(box);
    sampled_.clear();
    for (std::size_t i = 0; i < triangles.size(); i += stride) sampled_.push_back(&triangles[i]);
    features_.resize(static_cast<Eigen::Index>(sampled_.size()), 6);
    for (std::size_t i = 0; i < sampled_.size(); ++i) {
      features_.row(static_cast<Eigen::Index>(i)) =
          featureOf(*sampled_[i], box.center, normal_weight).transpose();
    }
  }

  struct Split {
    Plane plane;
    BoxF low, high;
    float volume;
  };

  /// The best of the seeds, each improved by Lloyd steps; none where no seed has two sides.
  std::optional<Split> bestSplit(const BoxF& box) {
    std::optional<Split> best;
    std::vector<float>& seen = errors_;
    seen.clear();
    const float longest = box.half_extents.maxCoeff();
    std::array<int, 3> axis = {0, 1, 2};
    std::ranges::sort(axis, std::greater{}, [&](int k) { return std::pair(box.half_extents[k], -k); });
    for (int seed = 0; seed < 4; ++seed) {
      Plane plane{Feature::Zero()};
      if (seed < 3) {
        const int k = axis[static_cast<std::size_t>(seed)];
        if (seed > 0 && box.half_extents[k] < kThinAxis * longest) continue;
        plane.normal.head<3>() = box.axes.col(k);
      } else {
        plane.normal.tail<3>() = principalNormal();
      }
      const std::optional<float> error = lloyd(plane);
      if (!error) continue;
      const auto same = [&](float other) {
        return std::abs(other - *error) <= kSameError * std::abs(*error);
      };
      if (std::ranges::any_of(seen, same)) continue;
      seen.push_back(*error);
      const BoxF low = sideBox(plane, true), high = sideBox(plane, false);
      const float volume = slackVolume(low) + slackVolume(high);
      if (!best || volume < best->volume) best = Split{plane, low, high, volume};
    }
    return best;
  }

  /// The direction in which the sampled triangles face most, either way: parts the two faces of a blade.
  Eigen::Vector3f principalNormal() const {
    const auto normals = features_.rightCols<3>();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(normals.transpose() * normals);
    return solver.eigenvectors().col(2);
  }

  /// Lloyd steps for k = 2, as planes. Returns the squared error, up to a constant; none where a side runs
  /// empty.
  std::optional<float> lloyd(Plane& plane) const {
    const auto n = static_cast<float>(features_.rows());
    const Feature total = features_.colwise().sum().transpose();
    Side low_side;
    for (int step = 0;; ++step) {
      low_side = ((features_ * plane.normal).array() < plane.offset).cast<float>();
      const float low_count = low_side.sum(), high_count = n - low_count;
      if (low_count < 0.5f || high_count < 0.5f) return std::nullopt;
      const Feature low_sum = features_.transpose() * low_side;
      const Feature low_mean = low_sum / low_count, high_mean = (total - low_sum) / high_count;
      const float error = -(low_count * low_mean.squaredNorm() + high_count * high_mean.squaredNorm());
      if (step == kLloydSteps) return error;
      const Plane next{high_mean - low_mean, 0.5f * (high_mean.squaredNorm() - low_mean.squaredNorm())};
      const float change = (next.normal - plane.normal).lpNorm<1>() + std::abs(next.offset - plane.offset);
      plane = next;
      if (change <= kSettled * (plane.normal.lpNorm<1>() + std::abs(plane.offset))) return error;
    }
  }

  BoxF sideBox(const Plane& plane, bool low) {
    const Side height = features_ * plane.normal;
    const auto on_side = (height.array() < plane.offset) == low;
    vertices_.resize(3 * on_side.count(), 3);
    Eigen::Index row = 0;
    for (Eigen::Index i = 0; i < height.size(); ++i) {
      if (!on_side[i]) continue;
      for (const Eigen::Vector3f& vertex : sampled_[static_cast<std::size_t>(i)]->vertices) {
        vertices_.row(row++) = vertex.transpose();
      }
    }
    return fitBox(vertices_, slack_);
  }

  float slackVolume(const BoxF& box) const { return (2.0f * box.half_extents.array() + slack_).prod(); }

  const std::uint32_t capacity_;
  Partition partition_;
  float slack_ = 0.0f;
  VertexSample vertices_;
  FeatureSample features_;
  std::vector<const TriangleRecord*> sampled_;
  std::vector<float> errors_;
};

}  // namespace

Partition clusteringPartition(std::vector<TriangleRecord> records, int leaf_capacity) {
  return std::make_unique<ClusteringPartitioner>(std::move(records), leaf_capacity)->run();
}

}  // namespace octoblisk
