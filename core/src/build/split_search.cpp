#include "build/split_search.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/split_search.cpp"
#include <hwy/foreach_target.h>

#include "build/side_boxes-inl.h"
#include "build/side_frames-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

constexpr float kSameError = 2e-6f;  // relative: two seeds with the same error have found the same clusters

/// The direction in which most triangles face, up to sign; it separates the two faces of a blade. Squaring
/// the second moments three times suppresses the other directions.
HWY_INLINE void principalNormal(const SplitSearch& search, float direction[3]) {
  Float8 sums[6];
  for (Float8& moment : sums) moment = Float8(0.0f);
  for (std::size_t b = 0; b < search.blockCount(); ++b) {
    const auto& feature = search.blocks[b].feature;
    const Float8 x = Float8::load(feature[3]), y = Float8::load(feature[4]), z = Float8::load(feature[5]);
    const Float8 terms[6] = {x * x, x * y, x * z, y * y, y * z, z * z};
    for (int k = 0; k < 6; ++k) sums[k] = sums[k] + terms[k];
  }
  float xx = sum(sums[0]), xy = sum(sums[1]), xz = sum(sums[2]);
  float yy = sum(sums[3]), yz = sum(sums[4]), zz = sum(sums[5]);
  for (int squaring = 0; squaring < 3; ++squaring) {
    const float trace = xx + yy + zz, scale = trace > 0.0f ? 1.0f / trace : 0.0f;
    const float a = xx * scale, b = xy * scale, c = xz * scale, d = yy * scale, e = yz * scale,
                f = zz * scale;
    xx = a * a + b * b + c * c;
    xy = a * b + b * d + c * e;
    xz = a * c + b * e + c * f;
    yy = b * b + d * d + e * e;
    yz = b * c + d * e + e * f;
    zz = c * c + e * e + f * f;
  }
  // The longest column.
  const bool x_longest = xx >= yy && xx >= zz, y_longest = !x_longest && yy >= zz;
  direction[0] = x_longest ? xx : y_longest ? xy : xz;
  direction[1] = x_longest ? xy : y_longest ? yy : yz;
  direction[2] = x_longest ? xz : y_longest ? yz : zz;
}

/// The result of one pass over all triangles for a candidate's plane.
struct LowSide {
  float count;
  float sums[6];  ///< of the features
  bool changed;
};

/// Writes which triangles are below the plane.
HWY_INLINE LowSide lowSide(const SplitSearch& search, const SplitSearch::Candidate& plane, float* is_low) {
  Float8 normal[6], sums[6], lows(0.0f), changed(0.0f);
  for (int k = 0; k < 6; ++k) {
    normal[k] = Float8(plane.normal[k]);
    sums[k] = Float8(0.0f);
  }
  const Float8 offset(plane.offset), zero(0.0f);
  for (std::size_t b = 0; b < search.blockCount(); ++b) {
    const TriangleBlock& block = search.blocks[b];
    Float8 feature[6];
    for (int k = 0; k < 6; ++k) feature[k] = Float8::load(block.feature[k]);
    const Float8 height = ((normal[0] * feature[0] + normal[1] * feature[1]) +
                           (normal[2] * feature[2] + normal[3] * feature[3])) +
                          (normal[4] * feature[4] + normal[5] * feature[5]);
    const Float8 low = select(height, offset, Float8::load(block.present), zero);
    changed = max(changed, abs(low - Float8::load(is_low + b * kLanes)));
    low.store(is_low + b * kLanes);
    lows = lows + low;
    for (int k = 0; k < 6; ++k) sums[k] = sums[k] + low * feature[k];
  }
  LowSide side;
  side.count = sum(lows);
  for (int k = 0; k < 6; ++k) side.sums[k] = sum(sums[k]);
  side.changed = less(zero, changed) != 0;
  return side;
}

/// Improves the candidate's plane by Lloyd steps and writes the sides. Returns false if a side becomes empty.
HWY_INLINE bool improve(const SplitSearch& search, const float total[6], SplitSearch::Candidate& candidate,
                        float* is_low) {
  const auto count = static_cast<float>(search.count);
  for (int step = 0;; ++step) {
    const LowSide low = lowSide(search, candidate, is_low);
    if (low.count == 0.0f || low.count == count) return false;
    const float per_low = 1.0f / low.count, per_high = 1.0f / (count - low.count);
    float low_square = 0.0f, high_square = 0.0f, next[6];
    for (int k = 0; k < 6; ++k) {
      const float low_mean = low.sums[k] * per_low, high_mean = (total[k] - low.sums[k]) * per_high;
      low_square += low_mean * low_mean;
      high_square += high_mean * high_mean;
      next[k] = high_mean - low_mean;
    }
    candidate.error = -(low.count * low_square + (count - low.count) * high_square);
    if (step == search.effort.lloyd_steps || (step > 0 && !low.changed)) return true;
    std::copy_n(next, 6, candidate.normal);
    candidate.offset = 0.5f * (high_square - low_square);
  }
}

/// The candidates from all seeds, without duplicates of equal error.
HWY_INLINE void findCandidates(SplitSearch& search) {
  Float8 totals[6];
  for (Float8& feature : totals) feature = Float8(0.0f);
  for (std::size_t b = 0; b < search.blockCount(); ++b) {
    for (int k = 0; k < 6; ++k) totals[k] = totals[k] + Float8::load(search.blocks[b].feature[k]);
  }
  float total[6];
  for (int k = 0; k < 6; ++k) total[k] = sum(totals[k]);

  search.candidate_count = 0;
  const int seeds = search.seed_count + (search.has_normal_seed ? 1 : 0);
  for (int seed = 0; seed < seeds; ++seed) {
    SplitSearch::Candidate& candidate = search.candidates[search.candidate_count];
    std::fill_n(candidate.normal, 6, 0.0f);
    candidate.offset = 0.0f;
    if (seed < search.seed_count) {
      std::copy_n(search.seed_axes[seed], 3, candidate.normal);
    } else {
      principalNormal(search, candidate.normal + 3);
    }
    if (!improve(search, total, candidate, search.is_low[search.candidate_count].data())) continue;
    bool seen = false;
    for (int c = 0; c < search.candidate_count; ++c) {
      seen |= std::abs(search.candidates[c].error - candidate.error) <= -kSameError * candidate.error;
    }
    if (!seen) ++search.candidate_count;
  }
}

void findBestSplit(SplitSearch& search) {
  search.best = -1;
  findCandidates(search);
  if (search.candidate_count == 0) return;
  findFrames(search);
  int counts[2];
  for (int c = 0; c < search.candidate_count; ++c) {
    SplitSearch::Candidate& candidate = search.candidates[c];
    listSides(search, c, counts);
    candidate.volume = turnBoxes(search, candidate, counts, kCoarseTurns);
    if (search.best < 0 || candidate.volume < search.candidates[search.best].volume) search.best = c;
  }
  if (!search.effort.refine_turn) return;
  if (search.best != search.candidate_count - 1) listSides(search, search.best, counts);
  turnBoxes(search, search.candidates[search.best], counts, kFineTurns);
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk::detail {

HWY_EXPORT(findBestSplit);

void findSplit(SplitSearch& search) { HWY_DYNAMIC_DISPATCH(findBestSplit)(search); }

}  // namespace octoblisk::detail
#endif
