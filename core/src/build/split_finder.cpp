#include "build/split_finder.h"

#include <algorithm>
#include <array>

namespace octoblisk::detail {
namespace {

constexpr float kNormalWeight = 0.25f;  // of a unit normal, relative to the largest half extent
constexpr float kThinAxis = 0.25f;      // axes shorter than this fraction of the longest are not seeds

/// The search's box of one side, converted to the records' frame.
BoxF boxOf(const SplitSearch::Side& side, const Eigen::Vector3f& center, float size) {
  BoxF box;
  Eigen::Vector3f low, high;
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) box.axes(i, k) = side.axes[k][i];
    low[k] = side.low[k];
    high[k] = side.high[k];
  }
  box.half_extents = (0.5f * size) * (high - low);
  box.center = center + box.axes * ((0.5f * size) * (low + high));
  return box;
}

}  // namespace

SplitFinder::SplitFinder() {
  constexpr std::size_t kBlocks = kMaxSamples / kLanes;
  search_.blocks.resize(kBlocks);
  search_.moments.resize(kBlocks * 9 * kLanes + kLanes);
  for (auto& is_low : search_.is_low) is_low.resize(kMaxSamples);
  for (auto& side : search_.side) side.resize(kMaxSamples + 1);
}

void SplitFinder::fill(std::span<const TriangleRecord> records, std::span<const std::uint32_t> indices,
                       const Eigen::Vector3f& center, float scale, int samples) {
  const std::size_t stride =
      (indices.size() + static_cast<std::size_t>(samples) - 1) / static_cast<std::size_t>(samples);
  const std::size_t count = (indices.size() + stride - 1) / stride;
  for (std::size_t i = 0; i < count; ++i) {
    TriangleBlock& block = search_.blocks[i / kLanes];
    const std::size_t lane = i % kLanes;
    const TriangleRecord& record = records[indices[i * stride]];
    for (std::size_t c = 0; c < 3; ++c) {
      for (int k = 0; k < 3; ++k) {
        block.corner[c][k][lane] = (record.vertices[c][k] - center[k]) * scale;
      }
    }
    for (int k = 0; k < 3; ++k) {
      block.feature[k][lane] = (record.centroid[k] - center[k]) * scale;
      block.feature[3 + k][lane] = kNormalWeight * record.normal[k];
    }
    block.present[lane] = 1.0f;
  }
  for (std::size_t i = count; i % kLanes != 0; ++i) {
    TriangleBlock& block = search_.blocks[i / kLanes];
    const std::size_t lane = i % kLanes;
    for (auto& row : block.feature) row[lane] = 0.0f;
    for (auto& corner : block.corner) {
      for (auto& row : corner) row[lane] = 0.0f;
    }
    block.present[lane] = 0.0f;
  }
  search_.count = static_cast<int>(count);
  saw_all_ = stride == 1;
}

void SplitFinder::chooseSeeds(const BoxF& box) {
  const bool one = search_.count < search_.effort.one_seed_below;
  const int most = one ? 1 : search_.effort.axis_seeds;
  const Eigen::Vector3f& extent = box.half_extents;
  std::array<int, 3> axis = {0, 1, 2};
  if (extent[axis[0]] < extent[axis[1]]) std::swap(axis[0], axis[1]);
  if (extent[axis[1]] < extent[axis[2]]) std::swap(axis[1], axis[2]);
  if (extent[axis[0]] < extent[axis[1]]) std::swap(axis[0], axis[1]);
  int seeds = 0;
  for (const int k : axis) {
    if (seeds == most || (seeds > 0 && extent[k] < kThinAxis * extent[axis[0]])) break;
    for (int i = 0; i < 3; ++i) search_.seed_axes[seeds][i] = box.axes(i, k);
    ++seeds;
  }
  search_.seed_count = seeds;
  search_.has_normal_seed = !one;
}

std::optional<SplitFinder::Split> SplitFinder::find(std::span<const TriangleRecord> records,
                                                    std::span<const std::uint32_t> indices, const BoxF& box,
                                                    float slack, const SplitEffort& effort) {
  constexpr float kSmallest = 1e-36f;  // for smaller sizes, 1 / size is not finite
  const float size = std::max(box.half_extents.maxCoeff(), kSmallest), scale = 1.0f / size;
  search_.effort = effort;
  search_.slack = slack * scale;
  fill(records, indices, box.center, scale, effort.samples);
  chooseSeeds(box);
  findSplit(search_);
  if (search_.best < 0) return std::nullopt;
  const SplitSearch::Candidate& best = search_.candidates[search_.best];
  plane_.of_centroid = scale * Eigen::Map<const Eigen::Vector3f>(best.normal);
  plane_.of_normal = kNormalWeight * Eigen::Map<const Eigen::Vector3f>(best.normal + 3);
  plane_.offset = best.offset + plane_.of_centroid.dot(box.center);
  return Split{boxOf(best.sides[0], box.center, size), boxOf(best.sides[1], box.center, size)};
}

}  // namespace octoblisk::detail
