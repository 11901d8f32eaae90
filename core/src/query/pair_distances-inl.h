// The distances of triangle pairs, in single precision: eight pairs at a time, of any leaves.
// Included once for each target (simd-inl.h).
#if defined(OCTOBLISK_QUERY_PAIR_DISTANCES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_QUERY_PAIR_DISTANCES_INL_H
#undef OCTOBLISK_QUERY_PAIR_DISTANCES_INL_H
#else
#define OCTOBLISK_QUERY_PAIR_DISTANCES_INL_H
#endif

#include <array>
#include <span>

#include "octoblisk/contact.h"
#include "query/distance_search.h"
#include "query/leaf_pair-inl.h"
#include "simd/lanes.h"
#include "simd/triangle8-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// Up to eight triangle pairs that do not meet.
class PairDistances {
 public:
  std::uint32_t count() const { return count_; }
  bool isFull() const { return count_ == kLanes; }
  void clear() { count_ = 0; }

  HWY_INLINE void add(const LeafPair& leaves, std::uint32_t i, std::uint32_t j) {
    for (std::uint32_t row = 0; row < 9; ++row) {
      of_a_[row][count_] = leaves.coordinateOfA(row, i);
      of_b_[row][count_] = leaves.coordinateOfB(row, j);
    }
    unit_[count_] = leaves.unit();
    rounding_[count_] = leaves.planeRounding();
    pairs_[count_++] = {leaves.triangleA(i), leaves.triangleB(j)};
  }

  std::span<const TrianglePair> pairs() const { return {pairs_.data(), count_}; }

  /// Bounds of the true distances; arbitrary beyond the pairs.
  HWY_INLINE DistanceBounds8 bounds() const {
    const Triangle8 of_a = triangles(of_a_), of_b = triangles(of_b_);
    const Float8 squared = squaredDistance(of_a, of_b);
    const Float8 rounding = Float8::load(rounding_.data()), size = Float8(1.0f) / Float8::load(unit_.data());
    DistanceBounds8 result;
    least(of_a, of_b, squared, size, rounding).store(result.least.data());
    most(squared, size, rounding).store(result.most.data());
    return result;
  }

  /// Those of the pairs that may be within `limit`.
  HWY_INLINE unsigned within(float limit) const {
    const Triangle8 of_a = triangles(of_a_), of_b = triangles(of_b_);
    const Float8 rounding = Float8::load(rounding_.data()), size = Float8(1.0f) / Float8::load(unit_.data());
    const Float8 apart = least(of_a, of_b, squaredDistance(of_a, of_b), size, rounding);
    return ((1u << count_) - 1u) & ~less(Float8(limit), apart);
  }

 private:
  using Corners = std::array<std::array<float, kLanes>, 9>;  // [3 · corner + coordinate][pair]

  /// Up to rounding.
  static HWY_INLINE Float8 squaredDistance(const Triangle8& of_a, const Triangle8& of_b) {
    Float8 squared(1e38f);
    for (int v = 0; v < 3; ++v) {
      for (int w = 0; w < 3; ++w) {
        const Vec8 between = of_a.corner[v] - of_b.corner[w];
        squared = min(squared, closestOnSegments(of_a.edge[v], of_b.edge[w], between).squared);
      }
      squared = min(squared, squaredFaceDistance(of_a.corner[v], of_b));
      squared = min(squared, squaredFaceDistance(of_b.corner[v], of_a));
    }
    return squared;
  }

  /// Lower bounds of the true distances. If segments are nearly parallel, rounding moves the closest points
  /// along them. At worst, when the sine is about the root of the rounding error, this loses 60 units in the
  /// last place of their squared length.
  static HWY_INLINE Float8 least(const Triangle8& of_a, const Triangle8& of_b, const Float8& squared,
                                 const Float8& size, const Float8& rounding) {
    const Float8 lost = Float8(0x1p-18f) * max(of_a.longest, of_b.longest);
    return (sqrt(max(squared - lost, Float8(0.0f))) - max(of_a.thin, of_b.thin)) * size - rounding;
  }

  /// Upper bounds of the true distances.
  static HWY_INLINE Float8 most(const Float8& squared, const Float8& size, const Float8& rounding) {
    return sqrt(squared) * size + rounding;
  }

  HWY_INLINE Triangle8 triangles(const Corners& corners) const {
    const Float8 unit = Float8::load(unit_.data());
    const auto corner = [&](std::size_t v) HWY_ATTR {
      return Vec8(Float8::load(corners[3 * v].data()), Float8::load(corners[3 * v + 1].data()),
                  Float8::load(corners[3 * v + 2].data())) *
             unit;
    };
    return {corner(0), corner(1), corner(2)};
  }

  Corners of_a_ = {}, of_b_ = {};  // in the frames of A's leaves
  std::array<float, kLanes> unit_ = {1, 1, 1, 1, 1, 1, 1, 1}, rounding_ = {};
  std::array<TrianglePair, kLanes> pairs_;
  std::uint32_t count_ = 0;
};

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
