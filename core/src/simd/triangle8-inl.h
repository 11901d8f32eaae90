// Eight triangles at once, and the distances between their edges and faces in single precision. Included once
// for each target (simd-inl.h).
#if defined(OCTOBLISK_SIMD_TRIANGLE8_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_SIMD_TRIANGLE8_INL_H
#undef OCTOBLISK_SIMD_TRIANGLE8_INL_H
#else
#define OCTOBLISK_SIMD_TRIANGLE8_INL_H
#endif

#include "base/rounding.h"
#include "simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

HWY_INLINE Float8 clamped01(const Float8& x) { return min(max(x, Float8(0.0f)), Float8(1.0f)); }

/// A squared length that is safe to divide by.
HWY_INLINE Float8 nonzero(const Float8& squared) { return max(squared, Float8(1e-37f)); }

/// An edge, its squared length and the reciprocal of that.
struct Edge8 {
  Vec8 along;
  Float8 squared, reciprocal;

  Edge8() = default;
  HWY_INLINE explicit Edge8(const Vec8& edge)
      : along(edge), squared(dot(edge, edge)), reciprocal(Float8(1.0f) / nonzero(squared)) {}
};

/// The closest points p + s·u and q + t·v of two segments, and their squared distance.
struct ClosestOnSegments8 {
  Float8 squared, s, t;
};

/// The closest points of the segments p + s·u and q + t·v, with s and t in [0, 1] and `offset` = p − q
/// (C. Ericson, Real-Time Collision Detection, 5.1.9). The distance is never less than the true one, up to
/// rounding. s and t are exactly 0 or 1 at ends of the segments.
HWY_INLINE ClosestOnSegments8 closestOnSegments(const Edge8& u, const Edge8& v, const Vec8& offset) {
  const Float8 uv = dot(u.along, v.along), u_offset = dot(u.along, offset), v_offset = dot(v.along, offset);
  const Float8 start =
      clamped01((uv * v_offset - u_offset * v.squared) / nonzero(u.squared * v.squared - uv * uv));
  const Float8 t = clamped01((uv * start + v_offset) * v.reciprocal);
  const Float8 s = clamped01((uv * t - u_offset) * u.reciprocal);
  const Vec8 apart = offset + u.along * s - v.along * t;
  return {dot(apart, apart), s, t};
}

/// Eight triangles with the data that distances need.
struct Triangle8 {
  Vec8 corner[3];
  Edge8 edge[3];
  Vec8 normal, outward[3];      // from the edges, in the triangle's plane
  Float8 longest;               // squared edge
  Float8 reciprocal_of_normal;  // squared
  Float8 thin;  ///< above 0 for triangles too thin to have a normal: an upper bound of their width

  HWY_INLINE Triangle8(const Vec8& first, const Vec8& second, const Vec8& third)
      : corner{first, second, third} {
    for (int v = 0; v < 3; ++v) edge[v] = Edge8(corner[(v + 1) % 3] - corner[v]);
    normal = cross(edge[0].along, edge[1].along);
    for (int v = 0; v < 3; ++v) outward[v] = cross(edge[v].along, normal);
    const Float8 squared_normal = dot(normal, normal);
    reciprocal_of_normal = Float8(1.0f) / nonzero(squared_normal);
    longest = max(edge[0].squared, max(edge[1].squared, edge[2].squared));
    constexpr float kThin = 0x1p-10f;  // of sin²
    const Float8 rounding = Float8(static_cast<float>(kSingleRounding)) * sqrt(longest) + Float8(0x1p-100f);
    const Float8 width = sqrt(squared_normal / nonzero(longest)) + rounding;
    thin = select(squared_normal, Float8(kThin) * longest * longest + Float8(0x1p-100f), width, Float8(0.0f));
  }
};

/// The squared distance of a point to the triangle's plane if its foot is inside the triangle; a huge number
/// otherwise, or if the triangle is thin.
HWY_INLINE Float8 squaredFaceDistance(const Vec8& point, const Triangle8& face) {
  const Float8 far(1e38f), height = dot(face.normal, point - face.corner[0]);
  Float8 outside = face.thin;
  for (int i = 0; i < 3; ++i) {
    outside = max(outside, dot(face.outward[i], point - face.corner[i]));
  }
  return select(Float8(0.0f), outside, far, height * height * face.reciprocal_of_normal);
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
