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

/// Three corners with what distances to them need.
struct Corners8 {
  Vec8 corner[3], edge[3], normal;
  Float8 squared[3];  // of the edges
  Float8 longest;     // squared edge
  Float8 squared_normal;
  Float8 thin;  ///< above 0 for triangles too thin to have a normal: no more than this wide

  HWY_INLINE explicit Corners8(const Vec8 corners[3]) {
    for (int v = 0; v < 3; ++v) corner[v] = corners[v];
    for (int v = 0; v < 3; ++v) {
      edge[v] = corner[(v + 1) % 3] - corner[v];
      squared[v] = dot(edge[v], edge[v]);
    }
    normal = cross(edge[0], edge[1]);
    squared_normal = dot(normal, normal);
    longest = max(squared[0], max(squared[1], squared[2]));
    constexpr float kThin = 0x1p-10f;  // of sin²
    thin = select(squared_normal, Float8(kThin) * longest * longest + Float8(0x1p-100f),
                  Float8(0x1p-4f) * sqrt(longest) + Float8(0x1p-100f), Float8(0.0f));
  }
};

/// The squared distance of a point to the triangle's plane where its foot is inside the triangle, else, and
/// where it is thin, far.
HWY_INLINE Float8 squaredFaceDistance(const Vec8& point, const Corners8& face) {
  const Float8 far(1e38f), height = dot(face.normal, point - face.corner[0]);
  Float8 outside = face.thin;
  for (int i = 0; i < 3; ++i) {
    outside = max(outside, dot(cross(face.edge[i], face.normal), point - face.corner[i]));
  }
  return select(Float8(0.0f), outside, far, height * height / nonzero(face.squared_normal));
}

/// The triangles of B's leaf, to be found near those of A.
class NearTriangles {
 public:
  HWY_INLINE explicit NearTriangles(const LeafPair& leaves) : leaves_(leaves), unit_(leaves.unit()) {
    for (std::uint32_t v = 0; v < 3; ++v) corner_[v] = leaves.cornersOfB(v);
    low_ = min(corner_[0], min(corner_[1], corner_[2]));
    high_ = max(corner_[0], max(corner_[1], corner_[2]));
  }

  /// Those whose bounds are no farther than `limit` from the bounds of triangle i of A.
  HWY_INLINE unsigned boundsWithin(std::uint32_t i, float limit) const {
    const Vec8 corner[3] = {leaves_.cornerOfA(i, 0), leaves_.cornerOfA(i, 1), leaves_.cornerOfA(i, 2)};
    const Vec8 low = min(corner[0], min(corner[1], corner[2])),
               high = max(corner[0], max(corner[1], corner[2]));
    const Float8 zero(0.0f);
    const Vec8 apart = max(Vec8(zero, zero, zero), max(low_ - high, low - high_));
    const float reach = limit + leaves_.planeRounding();
    return lanes() & ~less(Float8(reach * reach), dot(apart, apart));
  }

  struct Distances {
    float least[kLanes], most[kLanes];  ///< the true one is between
  };

  /// The distances from triangle i of A to those that do not meet it.
  HWY_INLINE Distances distances(std::uint32_t i) const {
    const Float8 unit(unit_);
    const Vec8 corners_of_one[3] = {leaves_.cornerOfA(i, 0) * unit, leaves_.cornerOfA(i, 1) * unit,
                                    leaves_.cornerOfA(i, 2) * unit};
    const Vec8 corners_of_eight[3] = {corner_[0] * unit, corner_[1] * unit, corner_[2] * unit};
    const Corners8 one(corners_of_one), eight(corners_of_eight);
    Float8 least(1e38f);
    for (int v = 0; v < 3; ++v) {
      for (int w = 0; w < 3; ++w) {
        least = min(least, squaredSegmentDistance(one.edge[v], eight.edge[w], one.corner[v] - eight.corner[w],
                                                  one.squared[v], eight.squared[w]));
      }
      least = min(least,
                  min(squaredFaceDistance(one.corner[v], eight), squaredFaceDistance(eight.corner[v], one)));
    }
    // Of segments all but parallel, rounding moves the closest points along them, at worst where the sine is
    // about its root: a unit in the last place of the square of their length is lost then, times 60.
    const Float8 lost = Float8(0x1p-18f) * max(one.longest, eight.longest);
    const Float8 rounding(leaves_.planeRounding()), size(1.0f / unit_);
    Distances result;
    ((sqrt(max(least - lost, Float8(0.0f))) - max(one.thin, eight.thin)) * size - rounding)
        .store(result.least);
    (sqrt(least) * size + rounding).store(result.most);
    return result;
  }

 private:
  unsigned lanes() const { return (1u << leaves_.countB()) - 1u; }

  const LeafPair& leaves_;
  const float unit_;
  Vec8 corner_[3], low_, high_;
};

}  // namespace octoblisk::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
