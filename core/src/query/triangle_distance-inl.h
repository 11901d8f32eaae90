// Which triangles of two leaves may be near each other, in single precision: one triangle against eight at a
// time. Included once for each target (simd-inl.h).
#if defined(OCTOBLISK_QUERY_TRIANGLE_DISTANCE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_QUERY_TRIANGLE_DISTANCE_INL_H
#undef OCTOBLISK_QUERY_TRIANGLE_DISTANCE_INL_H
#else
#define OCTOBLISK_QUERY_TRIANGLE_DISTANCE_INL_H
#endif

#include "query/leaf_pair-inl.h"
#include "simd/triangle8-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// The triangles of B's leaf, for distances to those of A.
class TriangleDistances {
 public:
  HWY_INLINE explicit TriangleDistances(const LeafPair& leaves)
      : leaves_(leaves),
        unit_(leaves.unit()),
        eight_(scaled(leaves.cornerOfB(0)), scaled(leaves.cornerOfB(1)), scaled(leaves.cornerOfB(2))) {}

  struct Distances {
    float least[kLanes], most[kLanes];  ///< bounds of the true distance

    /// Bit j: distance j may be within the limit.
    HWY_INLINE unsigned within(float limit) const {
      return kAllLanes & ~less(Float8(limit), Float8::load(least));
    }
  };

  /// From triangle i of A to the triangles that do not meet it.
  HWY_INLINE Distances from(std::uint32_t i) const {
    const Triangle8 one(scaled(leaves_.cornerOfA(i, 0)), scaled(leaves_.cornerOfA(i, 1)),
                        scaled(leaves_.cornerOfA(i, 2)));
    Float8 least(1e38f);
    for (int v = 0; v < 3; ++v) {
      for (int w = 0; w < 3; ++w) {
        least =
            min(least, squaredSegmentDistance(one.edge[v], eight_.edge[w], one.corner[v] - eight_.corner[w]));
      }
      least = min(
          least, min(squaredFaceDistance(one.corner[v], eight_), squaredFaceDistance(eight_.corner[v], one)));
    }
    // If segments are nearly parallel, rounding moves the closest points along them. At worst, when the sine
    // is about the root of the rounding error, this loses 60 units in the last place of their squared length.
    const Float8 lost = Float8(0x1p-18f) * max(one.longest, eight_.longest);
    const Float8 rounding(leaves_.planeRounding()), size(1.0f / unit_);
    Distances result;
    ((sqrt(max(least - lost, Float8(0.0f))) - max(one.thin, eight_.thin)) * size - rounding)
        .store(result.least);
    (sqrt(least) * size + rounding).store(result.most);
    return result;
  }

 private:
  HWY_INLINE Vec8 scaled(const Vec8& corner) const { return corner * Float8(unit_); }

  const LeafPair& leaves_;
  const float unit_;
  Triangle8 eight_;
};

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
