// The triangles of two leaves side by side, and which of them are near each other by their bounds. Included
// once for each target (simd-inl.h).
#if defined(OCTOBLISK_QUERY_LEAF_PAIR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_QUERY_LEAF_PAIR_INL_H
#undef OCTOBLISK_QUERY_LEAF_PAIR_INL_H
#else
#define OCTOBLISK_QUERY_LEAF_PAIR_INL_H
#endif

#include <algorithm>
#include <cmath>

#include "base/rounding.h"
#include "query/local_pose.h"
#include "simd/lanes.h"
#include "simd/simd-inl.h"
#include "simd/unit.h"
#include "tree/node_boxes-inl.h"
#include "tree/tree.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// The triangles of two leaves that are near each other, in the frame of A's leaf. There, boxes are tight and
/// single precision is accurate enough for most decisions.
class LeafPair {
 public:
  HWY_INLINE LeafPair(const Tree& a, const Tree& b, const LocalPose& pose, Slot slot_a, Slot slot_b)
      : a_(a),
        b_(b),
        leaf_a_(a.child(slot_a)),
        leaf_b_(b.child(slot_b)),
        rows_a_(a.leafVertices(slot_a, corners_a_)),
        rows_b_(b.leafVertices(slot_b, corners_b_)) {
    Box8 room_a(Box8::Unset{}), room_b(Box8::Unset{});
    const Box8 &boxes_a = boxesAt(a, slot_a, room_a), &boxes_b = boxesAt(b, slot_b, room_b);
    const std::uint32_t lane_a = slot_a.lane, lane_b = slot_b.lane;
    double between[3];  // of the centres, in A's local frame
    for (int i = 0; i < 3; ++i) {
      between[i] = pose.exact.translation[i] - double(boxes_a.center[i][lane_a]);
      for (int k = 0; k < 3; ++k) between[i] += pose.exact.rotation(i, k) * double(boxes_b.center[k][lane_b]);
    }
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) frame_[i][k] = boxes_a.axes[k][i][lane_a];
      const float x = frame_[i][0], y = frame_[i][1], z = frame_[i][2];
      shift_[i] = x * static_cast<float>(between[0]) + y * static_cast<float>(between[1]) +
                  z * static_cast<float>(between[2]);
      const auto& rotation = pose.b_to_a.rotation;
      float turned[3];
      for (int k = 0; k < 3; ++k) turned[k] = x * rotation(0, k) + y * rotation(1, k) + z * rotation(2, k);
      for (int j = 0; j < 3; ++j) {
        rotation_[i][j] = turned[0] * boxes_b.axes[0][j][lane_b] + turned[1] * boxes_b.axes[1][j][lane_b] +
                          turned[2] * boxes_b.axes[2][j][lane_b];
      }
    }
    size_ = boxes_a.largestHalfExtent(lane_a) + boxes_b.largestHalfExtent(lane_b) +
            std::max({std::abs(shift_[0]), std::abs(shift_[1]), std::abs(shift_[2])});
    doubles_ = static_cast<float>(pose.doubles);
    for (std::uint32_t v = 0; v < 3; ++v) poseCornersOfB(v);
  }

  LeafPair(const LeafPair&) = delete;
  LeafPair& operator=(const LeafPair&) = delete;

  std::uint32_t countA() const { return leaf_a_.count(); }
  std::uint32_t countB() const { return leaf_b_.count(); }
  unsigned lanesOfB() const { return (1u << countB()) - 1u; }
  std::uint32_t triangleA(std::uint32_t i) const { return a_.triangles(leaf_a_)[i]; }
  std::uint32_t triangleB(std::uint32_t j) const { return b_.triangles(leaf_b_)[j]; }

  /// Corner v of triangle i of A, repeated in all lanes.
  HWY_INLINE Vec8 cornerOfA(std::uint32_t i, std::uint32_t v) const {
    const float* x = rows_a_ + 3 * v * countA() + i;
    return {Float8(x[0]), Float8(x[countA()]), Float8(x[2 * countA()])};
  }

  /// Corner v of the triangles of B; lanes beyond their count are arbitrary.
  HWY_INLINE Vec8 cornerOfB(std::uint32_t v) const {
    return {Float8::load(rows_in_a_[3 * v]), Float8::load(rows_in_a_[3 * v + 1]),
            Float8::load(rows_in_a_[3 * v + 2])};
  }

  /// Row 3 v + k: coordinate k of corner v of one triangle.
  float coordinateOfA(std::uint32_t row, std::uint32_t i) const { return rows_a_[row * countA() + i]; }
  float coordinateOfB(std::uint32_t row, std::uint32_t j) const { return rows_in_a_[row][j]; }

  /// Which triangles may be near each other.
  struct Near {
    unsigned of_a = 0;    ///< bit i: triangle i of A is near some of B
    unsigned of[kLanes];  ///< [i], bit j: triangles i of A and j of B are near each other
  };

  /// The triangles whose bounds are within `reach` of each other. `reach` is a length; the combined rounding
  /// error of three coordinates is less than twice coordinateRounding().
  HWY_INLINE Near within(float reach) const {
    const Vec8 low = min(cornerOfB(0), min(cornerOfB(1), cornerOfB(2))),
               high = max(cornerOfB(0), max(cornerOfB(1), cornerOfB(2)));
    float low_of_a[3][kLanes], high_of_a[3][kLanes];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto row = [&](std::uint32_t v) HWY_ATTR { return rowOfA(3 * v + k); };
      min(row(0), min(row(1), row(2))).store(low_of_a[k]);
      max(row(0), max(row(1), row(2))).store(high_of_a[k]);
    }
    const Float8 zero(0.0f), limit(reach * reach);
    Near near;
    for (std::uint32_t i = 0; i < countA(); ++i) {
      const auto gap = [&](int k, const Float8& low_of_b, const Float8& high_of_b) HWY_ATTR {
        return max(zero, max(Float8(low_of_a[k][i]) - high_of_b, low_of_b - Float8(high_of_a[k][i])));
      };
      const Vec8 apart{gap(0, low.x, high.x), gap(1, low.y, high.y), gap(2, low.z, high.z)};
      near.of[i] = lanesOfB() & ~less(limit, dot(apart, apart));
      near.of_a |= static_cast<unsigned>(near.of[i] != 0) << i;
    }
    return near;
  }

  /// Keeps the triangles that are within `reach` of each other along a unit vector from A to B in A's local
  /// frame. `reach` includes planeRounding().
  HWY_INLINE void keepWithin(float reach, const Eigen::Vector3f& direction, Near& near) const {
    const auto along_axis = [&](int i) HWY_ATTR {
      return Float8(frame_[i][0] * direction[0] + frame_[i][1] * direction[1] + frame_[i][2] * direction[2]);
    };
    const Vec8 along{along_axis(0), along_axis(1), along_axis(2)};
    Float8 low_of_b(3e38f), high_of_a(-3e38f);
    for (std::uint32_t v = 0; v < 3; ++v) {
      low_of_b = min(low_of_b, dot(along, cornerOfB(v)));
      high_of_a = max(high_of_a, dot(along, Vec8::load(rows_a_ + 3 * v * countA(), countA())));
    }
    float high[kLanes];
    high_of_a.store(high);
    const Float8 limit(reach);
    for (const std::uint32_t i : Lanes(near.of_a)) {
      near.of[i] &= ~less(limit, low_of_b - Float8(high[i]));
      if (near.of[i] == 0) near.of_a &= ~(1u << i);
    }
  }

  // Errors in units in the last place of the size, with half diagonals below 1.74 half extents: a corner of A
  // is off by 1. A corner of B is off by 1, by 16 because B's axes are not exactly orthonormal, by 16 for the
  // product of three rotations, 2 for the products, 3 for their sums, and 8 for the shift. The error of A's
  // axes stretches everything alike.

  /// The combined rounding error of a corner of A and one of B along each axis.
  float coordinateRounding() const { return static_cast<float>(kSingleRounding) * size_ + doubles_; }
  /// Scales all lengths to about 1.
  float unit() const { return unitOf(size_); }
  /// The rounding error of a height over a triangle's plane, or of a gap along a unit vector.
  float planeRounding() const { return 0x1p-16f * size_ + 4.0f * doubles_; }

 private:
  HWY_INLINE Float8 rowOfA(std::uint32_t row) const { return Float8::load(rows_a_ + row * countA()); }

  HWY_INLINE void poseCornersOfB(std::uint32_t v) {
    const Vec8 corner = Vec8::load(rows_b_ + 3 * v * countB(), countB());
    for (std::uint32_t i = 0; i < 3; ++i) {
      (Float8(rotation_[i][0]) * corner.x + Float8(rotation_[i][1]) * corner.y +
       Float8(rotation_[i][2]) * corner.z + Float8(shift_[i]))
          .store(rows_in_a_[3 * v + i]);
    }
  }

  const Tree &a_, &b_;
  const Child leaf_a_, leaf_b_;
  LeafVertices corners_a_, corners_b_;  // buffers for the corners of compact trees
  const float *const rows_a_, *const rows_b_;
  float rows_in_a_[9][kLanes];  // the corners of B in the frame of A's leaf
  float frame_[3][3];           // rows: the axes of A's leaf in A's local frame
  float rotation_[3][3], shift_[3];
  float size_, doubles_;
};

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
