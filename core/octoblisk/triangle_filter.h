// Which triangles of two leaves meet, in single precision: one triangle against eight at a time. Where
// rounding leaves the answer open, it says so. Read once for each target (simd.h).
#if defined(OCTOBLISK_TRIANGLE_FILTER_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_TRIANGLE_FILTER_H
#undef OCTOBLISK_TRIANGLE_FILTER_H
#else
#define OCTOBLISK_TRIANGLE_FILTER_H
#endif

#include <bit>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/node_boxes.h"
#include "octoblisk/simd.h"
#include "octoblisk/traversal_stack.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::HWY_NAMESPACE {

/// Two leaves close to each other, in the frame of A's leaf, where boxes are tight and single precision goes
/// a long way.
class LeafPair {
 public:
  HWY_INLINE LeafPair(const ClusteredOctree& a, const ClusteredOctree& b, const LocalPose& pose, Slot slot_a,
                      Slot slot_b)
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
      const float x = boxes_a.axes[0][i][lane_a], y = boxes_a.axes[1][i][lane_a],
                  z = boxes_a.axes[2][i][lane_a];
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
    doubles_ = static_cast<float>(0x1p-50 * pose.size);
  }

  LeafPair(const LeafPair&) = delete;
  LeafPair& operator=(const LeafPair&) = delete;

  std::uint32_t countA() const { return leaf_a_.count(); }
  std::uint32_t countB() const { return leaf_b_.count(); }
  std::uint32_t triangleA(std::uint32_t i) const { return a_.triangles(leaf_a_)[i]; }
  std::uint32_t triangleB(std::uint32_t j) const { return b_.triangles(leaf_b_)[j]; }

  /// Corner v of triangle i of A, the same in all lanes.
  HWY_INLINE Vec8 cornerOfA(std::uint32_t i, std::uint32_t v) const {
    const float* x = rows_a_ + 3 * v * countA() + i;
    return {Float8(x[0]), Float8(x[countA()]), Float8(x[2 * countA()])};
  }

  /// Corner v of the triangles of B; lanes beyond their count hold anything.
  HWY_INLINE Vec8 cornersOfB(std::uint32_t v) const {
    const float* x = rows_b_ + 3 * v * countB();
    const Vec8 corner{Float8::load(x), Float8::load(x + countB()), Float8::load(x + 2 * countB())};
    const auto along = [&](int i) HWY_ATTR {
      return Float8(rotation_[i][0]) * corner.x + Float8(rotation_[i][1]) * corner.y +
             Float8(rotation_[i][2]) * corner.z + Float8(shift_[i]);
    };
    return {along(0), along(1), along(2)};
  }

  // In units in the last place of the size, with half diagonals below 1.74 half extents: the axes of a box
  // are orthonormal but for 4; a corner of A is off by that and 1; one of B by 4 and 1, the product of three
  // rotations 16, the products 2, their sums 3, the shift 8.

  /// How far a corner of A and one of B may be off together, along each axis.
  float coordinateRounding() const { return 0x1p-18f * size_ + doubles_; }
  /// How far a height over a triangle's plane may be off.
  float planeRounding() const { return 0x1p-16f * size_ + 4.0f * doubles_; }

 private:
  const ClusteredOctree &a_, &b_;
  const Child leaf_a_, leaf_b_;
  LeafVertices corners_a_, corners_b_;  // room for those of compact trees
  const float *const rows_a_, *const rows_b_;
  float rotation_[3][3], shift_[3];
  float size_, doubles_;
};

/// The triangles of B's leaf with what all tests of them need.
class TriangleLanes {
 public:
  /// The triangles of B.
  HWY_INLINE explicit TriangleLanes(const LeafPair& leaves) : leaves_(leaves) {
    for (std::uint32_t v = 0; v < 3; ++v) corner_[v] = leaves.cornersOfB(v);
    for (int v = 0; v < 3; ++v) edge_[v] = corner_[(v + 1) % 3] - corner_[v];
    normal_ = cross(edge_[0], corner_[2] - corner_[0]);
    normal_magnitude_ = sumOfMagnitudes(normal_);
    const Float8 zero(0.0f), second = dot(normal_, edge_[0]), third = zero - dot(normal_, edge_[2]);
    low_ = min(zero, min(second, third));
    high_ = max(zero, max(second, third));
    squared_edge_ = max(dot(edge_[0], edge_[0]), max(dot(edge_[1], edge_[1]), dot(edge_[2], edge_[2])));
  }

  struct Verdicts {
    unsigned meet;  ///< bit i: meets triangle i for certain
    unsigned open;  ///< bit i: too close to call; all others do not meet
  };

  /// The verdicts on triangle i of A.
  HWY_INLINE Verdicts meet(std::uint32_t i) const {
    const Heights heights(*this, i);
    const unsigned open = lanes() & ~heights.apart(*this, leaves_.planeRounding());
    return open == 0 ? Verdicts{0, 0} : piercing(heights, open);
  }

  /// Those that may be within `reach` of triangle i of A.
  HWY_INLINE unsigned near(std::uint32_t i, float reach) const {
    return lanes() & ~Heights(*this, i).apart(*this, reach + leaves_.planeRounding());
  }

 private:
  static constexpr float kTiny = 1e-37f;  // more than denormal numbers can err

  unsigned lanes() const { return (1u << leaves_.countB()) - 1u; }

  /// The corners of each triangle over the plane of the other, times the plane's normal.
  struct Heights {
    Vec8 to[3];  // from the one's first corner to those of the eight
    Vec8 edge01, edge02;
    Float8 normal_magnitude;
    Float8 low, high;  // of the one's own corners: not 0 where it is so thin that its normal is rounding
    Float8 of_eight[3], of_one[3];

    HWY_INLINE Heights(const TriangleLanes& eight, std::uint32_t i) {
      const Vec8 origin = eight.leaves_.cornerOfA(i, 0);
      edge01 = eight.leaves_.cornerOfA(i, 1) - origin;
      edge02 = eight.leaves_.cornerOfA(i, 2) - origin;
      const Vec8 normal = cross(edge01, edge02);
      normal_magnitude = sumOfMagnitudes(normal);
      const Float8 zero(0.0f), second = dot(normal, edge01), third = dot(normal, edge02);
      low = min(zero, min(second, third));
      high = max(zero, max(second, third));
      for (int v = 0; v < 3; ++v) {
        to[v] = eight.corner_[v] - origin;
        of_eight[v] = dot(normal, to[v]);
      }
      of_one[0] = Float8(0.0f) - dot(eight.normal_, to[0]);
      of_one[1] = dot(eight.normal_, edge01) + of_one[0];
      of_one[2] = dot(eight.normal_, edge02) + of_one[0];
    }

    /// Those that one of the two planes parts by more than `reach`.
    HWY_INLINE unsigned apart(const TriangleLanes& eight, float reach) const {
      const Float8 part(reach), tiny(kTiny);
      const Float8 slack = part * normal_magnitude + tiny,
                   slack_of_eight = part * eight.normal_magnitude_ + tiny;
      return less(high + slack, min(min(of_eight[0], of_eight[1]), of_eight[2])) |
             less(max(max(of_eight[0], of_eight[1]), of_eight[2]), low - slack) |
             less(eight.high_ + slack_of_eight, min(min(of_one[0], of_one[1]), of_one[2])) |
             less(max(max(of_one[0], of_one[1]), of_one[2]), eight.low_ - slack_of_eight);
    }
  };

  /// Two triangles meet where an edge of one pierces the other: its ends are on both sides of the other's
  /// plane, and it passes the other's three edges on the same hand.
  HWY_INLINE Verdicts piercing(const Heights& heights, unsigned open) const {
    const auto& to = heights.to;
    const Float8 zero(0.0f);
    const Vec8 one_edge[3] = {heights.edge01, heights.edge02 - heights.edge01,
                              Vec8(zero, zero, zero) - heights.edge02};
    // Of no vector below is the length above twice this.
    const Float8 squared =
        max(max(squared_edge_, max(dot(one_edge[0], one_edge[0]),
                                   max(dot(one_edge[1], one_edge[1]), dot(one_edge[2], one_edge[2])))),
            max(dot(to[0], to[0]), max(dot(to[1], to[1]), dot(to[2], to[2]))));
    const Float8 slack =
        (Float8(18.0f * leaves_.coordinateRounding()) + Float8(0x1p-20f) * sqrt(squared)) * squared +
        Float8(kTiny);
    const Float8 minus_slack = zero - slack;

    // Which triangles each edge passes on one hand, for certain and perhaps: [0] left, [1] right.
    struct Passes {
      unsigned surely[2] = {kAllLanes, kAllLanes};
      unsigned maybe[2] = {kAllLanes, kAllLanes};
      HWY_INLINE void add(unsigned is_left, unsigned is_right) {
        surely[0] &= is_left;
        surely[1] &= is_right;
        maybe[0] &= ~is_right;
        maybe[1] &= ~is_left;
      }
    };
    Passes of_one[3], of_eight[3];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const Vec8 between = i == 0 ? to[j] : to[j] - (i == 1 ? heights.edge01 : heights.edge02);
        const Float8 volume = dot(cross(one_edge[i], edge_[j]), between);
        const unsigned is_left = less(slack, volume), is_right = less(volume, minus_slack);
        of_one[i].add(is_left, is_right);
        of_eight[j].add(is_left, is_right);
      }
    }
    unsigned meet = 0, may = 0;
    const auto add = [&](const Float8 height[3], const Passes edge[3]) HWY_ATTR {
      unsigned above[3], below[3];
      for (int v = 0; v < 3; ++v) {
        above[v] = less(slack, height[v]);
        below[v] = less(height[v], minus_slack);
      }
      for (int v = 0; v < 3; ++v) {
        const int w = (v + 1) % 3;
        const unsigned splits = (above[v] & below[w]) | (below[v] & above[w]);
        const unsigned same_side = (above[v] & above[w]) | (below[v] & below[w]);
        meet |= splits & (edge[v].surely[0] | edge[v].surely[1]);
        may |= ~same_side & (edge[v].maybe[0] | edge[v].maybe[1]);
      }
    };
    add(heights.of_eight, of_eight);
    add(heights.of_one, of_one);
    return {open & meet, open & may & ~meet};
  }

  Vec8 corner_[3], edge_[3], normal_;
  Float8 normal_magnitude_, squared_edge_;
  Float8 low_, high_;  // of their own corners over their first, along the normal: see Heights
  const LeafPair& leaves_;
};

}  // namespace octoblisk::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
