// Which triangles of two leaves may be near each other, in single precision: one triangle against eight at a
// time. Read once for each target (simd.h).
#if defined(OCTOBLISK_TRIANGLE_DISTANCE_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_TRIANGLE_DISTANCE_H
#undef OCTOBLISK_TRIANGLE_DISTANCE_H
#else
#define OCTOBLISK_TRIANGLE_DISTANCE_H
#endif

#include "octoblisk/triangle_filter.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::HWY_NAMESPACE {

HWY_INLINE Float8 clamped01(const Float8& x) { return min(max(x, Float8(0.0f)), Float8(1.0f)); }

/// A number that is not 0 to divide by, for squared lengths.
HWY_INLINE Float8 nonzero(const Float8& squared) { return max(squared, Float8(1e-37f)); }

/// The squared distances of segments p + s·u and q + t·v, s and t in [0, 1], where `offset` is p − q
/// (C. Ericson, Real-Time Collision Detection, 5.1.9). Never less than the true ones, but for rounding.
HWY_INLINE Float8 squaredSegmentDistance(const Vec8& u, const Vec8& v, const Vec8& offset, const Float8& uu,
                                         const Float8& vv) {
  const Float8 uv = dot(u, v), u_offset = dot(u, offset), v_offset = dot(v, offset);
  const Float8 start = clamped01((uv * v_offset - u_offset * vv) / nonzero(uu * vv - uv * uv));
  const Float8 t = clamped01((uv * start + v_offset) / nonzero(vv));
  const Float8 s = clamped01((uv * t - u_offset) / nonzero(uu));
  const Vec8 apart = offset + u * s - v * t;
  return dot(apart, apart);
}

/// The squared distance of a point to the triangle's plane where its foot is inside the triangle, else
/// infinite. `edge` in turn, `from` the corner that starts each, all relative to the point.
HWY_INLINE Float8 squaredFaceDistance(const Vec8 from[3], const Vec8 edge[3], const Vec8& normal) {
  const Float8 far(1e38f), height = dot(normal, from[0]);
  Float8 outside(0.0f);
  for (int i = 0; i < 3; ++i) outside = max(outside, dot(cross(normal, edge[i]), from[i]));
  return select(Float8(0.0f), outside, far, height * height / nonzero(dot(normal, normal)));
}

/// The triangles of B's leaf, to be found near those of A.
class NearTriangles {
 public:
  HWY_INLINE explicit NearTriangles(const LeafPair& leaves) : leaves_(leaves) {
    for (std::uint32_t v = 0; v < 3; ++v) corner_[v] = leaves.cornersOfB(v);
    low_ = min(corner_[0], min(corner_[1], corner_[2]));
    high_ = max(corner_[0], max(corner_[1], corner_[2]));
  }

  /// How far a distance may be off.
  HWY_INLINE float rounding() const { return leaves_.planeRounding(); }

  /// Those whose bounds are no farther than `limit` from the bounds of triangle i of A.
  HWY_INLINE unsigned boundsWithin(std::uint32_t i, float limit) const {
    const Vec8 corner[3] = {leaves_.cornerOfA(i, 0), leaves_.cornerOfA(i, 1), leaves_.cornerOfA(i, 2)};
    const Vec8 low = min(corner[0], min(corner[1], corner[2])),
               high = max(corner[0], max(corner[1], corner[2]));
    const Float8 zero(0.0f);
    const Vec8 apart = max(Vec8(zero, zero, zero), max(low_ - high, low - high_));
    const float reach = limit + rounding();
    return lanes() & ~less(Float8(reach * reach), dot(apart, apart));
  }

  /// The distances from triangle i of A to those that do not meet it.
  HWY_INLINE Float8 distances(std::uint32_t i) const {
    const Vec8 one[3] = {leaves_.cornerOfA(i, 0), leaves_.cornerOfA(i, 1), leaves_.cornerOfA(i, 2)};
    Vec8 one_edge[3], edge[3];
    Float8 one_squared[3], squared[3];
    for (int v = 0; v < 3; ++v) {
      one_edge[v] = one[(v + 1) % 3] - one[v];
      edge[v] = corner_[(v + 1) % 3] - corner_[v];
      one_squared[v] = dot(one_edge[v], one_edge[v]);
      squared[v] = dot(edge[v], edge[v]);
    }
    const Vec8 one_normal = cross(one_edge[0], one_edge[1]), normal = cross(edge[0], edge[1]);
    Float8 least(1e38f);
    for (int v = 0; v < 3; ++v) {
      Vec8 from_corner[3], from_one[3];
      for (int w = 0; w < 3; ++w) {
        const Vec8 offset = one[v] - corner_[w];
        least = min(least, squaredSegmentDistance(one_edge[v], edge[w], offset, one_squared[v], squared[w]));
        from_one[w] = corner_[w] - one[v];
        from_corner[w] = one[w] - corner_[v];
      }
      least = min(least, min(squaredFaceDistance(from_one, edge, normal),
                             squaredFaceDistance(from_corner, one_edge, one_normal)));
    }
    return sqrt(least);
  }

 private:
  unsigned lanes() const { return (1u << leaves_.countB()) - 1u; }

  const LeafPair& leaves_;
  Vec8 corner_[3], low_, high_;
};

}  // namespace octoblisk::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
