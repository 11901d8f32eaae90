// Which triangles of two leaves meet, in single precision: one triangle against eight at a time. Reports if
// rounding leaves the answer open. Included once for each target (simd-inl.h).
#if defined(OCTOBLISK_QUERY_TRIANGLE_FILTER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_QUERY_TRIANGLE_FILTER_INL_H
#undef OCTOBLISK_QUERY_TRIANGLE_FILTER_INL_H
#else
#define OCTOBLISK_QUERY_TRIANGLE_FILTER_INL_H
#endif

#include "query/leaf_pair-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// The triangles of B's leaf, with the data that all tests need.
class TriangleLanes {
 public:
  /// The triangles of B.
  HWY_INLINE explicit TriangleLanes(const LeafPair& leaves) : leaves_(leaves) {
    for (std::uint32_t v = 0; v < 3; ++v) corner_[v] = leaves.cornerOfB(v);
    for (int v = 0; v < 3; ++v) edge_[v] = corner_[(v + 1) % 3] - corner_[v];
    normal_ = cross(edge_[0], corner_[2] - corner_[0]);
    normal_magnitude_ = sumOfMagnitudes(normal_);
    unevenness_ = max(abs(dot(normal_, edge_[0])), abs(dot(normal_, edge_[2])));
    squared_edge_ = max(dot(edge_[0], edge_[0]), max(dot(edge_[1], edge_[1]), dot(edge_[2], edge_[2])));
  }

  struct Verdicts {
    unsigned meet;  ///< bit i: certainly meets triangle i
    unsigned open;  ///< bit i: too close to decide; all other triangles do not meet
  };

  /// The heights of the corners of each triangle over the plane of the other, times the length of the plane's
  /// normal. The normal of a sliver may be mostly rounding; then its own corners are off the plane by the
  /// unevenness.
  struct Heights {
    Vec8 to[3];  // from the first corner of the one triangle to the corners of the eight
    Vec8 edge01, edge02;
    Float8 normal_magnitude, unevenness;
    Float8 of_eight[3], of_one[3];

    HWY_INLINE Heights(const TriangleLanes& eight, std::uint32_t i) {
      const Vec8 origin = eight.leaves_.cornerOfA(i, 0);
      edge01 = eight.leaves_.cornerOfA(i, 1) - origin;
      edge02 = eight.leaves_.cornerOfA(i, 2) - origin;
      const Vec8 normal = cross(edge01, edge02);
      normal_magnitude = sumOfMagnitudes(normal);
      unevenness = max(abs(dot(normal, edge01)), abs(dot(normal, edge02)));
      for (int v = 0; v < 3; ++v) {
        to[v] = eight.corner_[v] - origin;
        of_eight[v] = dot(normal, to[v]);
      }
      of_one[0] = Float8(0.0f) - dot(eight.normal_, to[0]);
      of_one[1] = dot(eight.normal_, edge01) + of_one[0];
      of_one[2] = dot(eight.normal_, edge02) + of_one[0];
    }

    /// The triangles that one of the two planes separates by more than `reach`.
    HWY_INLINE unsigned apart(const TriangleLanes& eight, float reach) const {
      const Float8 zero(0.0f), part(reach), tiny(kTiny);
      const Float8 slack = part * normal_magnitude + unevenness + tiny,
                   slack_of_eight = part * eight.normal_magnitude_ + eight.unevenness_ + tiny;
      return less(slack, min(min(of_eight[0], of_eight[1]), of_eight[2])) |
             less(max(max(of_eight[0], of_eight[1]), of_eight[2]), zero - slack) |
             less(slack_of_eight, min(min(of_one[0], of_one[1]), of_one[2])) |
             less(max(max(of_one[0], of_one[1]), of_one[2]), zero - slack_of_eight);
    }
  };

  /// The heights for triangle i of A and all triangles of B.
  HWY_INLINE Heights heights(std::uint32_t i) const { return {*this, i}; }

  /// The verdicts on triangle i of A and the triangles of `near`.
  HWY_INLINE Verdicts meet(const Heights& heights, unsigned near) const {
    const unsigned open = near & ~heights.apart(*this, leaves_.planeRounding());
    return open == 0 ? Verdicts{0, 0} : piercing(heights, open);
  }

  /// The triangles of `near` that may be within `reach` of triangle i of A.
  HWY_INLINE unsigned within(float reach, const Heights& heights, unsigned near) const {
    return near & ~heights.apart(*this, reach + leaves_.planeRounding());
  }

 private:
  static constexpr float kTiny = 1e-37f;  // exceeds the error of subnormal numbers

  /// Two triangles meet if an edge of one pierces the other: the edge's ends are on both sides of the other's
  /// plane, and the edge passes the other's three edges on the same side.
  HWY_INLINE Verdicts piercing(const Heights& heights, unsigned open) const {
    const auto& to = heights.to;
    const Float8 zero(0.0f);
    const Vec8 one_edge[3] = {heights.edge01, heights.edge02 - heights.edge01,
                              Vec8(zero, zero, zero) - heights.edge02};
    // No vector below is longer than twice the root of this.
    const Float8 squared =
        max(max(squared_edge_, max(dot(one_edge[0], one_edge[0]),
                                   max(dot(one_edge[1], one_edge[1]), dot(one_edge[2], one_edge[2])))),
            max(dot(to[0], to[0]), max(dot(to[1], to[1]), dot(to[2], to[2]))));
    const Float8 slack = Float8(19.0f * leaves_.coordinateRounding()) * squared + Float8(kTiny);
    const Float8 minus_slack = zero - slack;

    // The triangles that each edge passes on one side, certainly and possibly: [0] left, [1] right.
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
  Float8 normal_magnitude_, unevenness_, squared_edge_;
  const LeafPair& leaves_;
};

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
