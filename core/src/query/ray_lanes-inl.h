// Tests a ray against eight boxes, or the triangles of a leaf, at once. Included once for each target
// (simd-inl.h).
//
// These tests only exclude what the ray certainly misses.
#if defined(OCTOBLISK_QUERY_RAY_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_QUERY_RAY_LANES_INL_H
#undef OCTOBLISK_QUERY_RAY_LANES_INL_H
#else
#define OCTOBLISK_QUERY_RAY_LANES_INL_H
#endif

#include <cmath>

#include "query/local_ray.h"
#include "simd/box_gap-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// Writes the eight reaches, above 0, at which a ray enters the boxes of a node. Returns a bit for each box
/// that it enters before `limit`.
HWY_INLINE unsigned enter(const Box8& boxes, const LocalRay& ray, float limit, float* reaches) {
  const Vec8 direction = Vec8::all(ray.direction), offset = Vec8::all(ray.origin) - centersOf(boxes);
  Float8 near(0x1p-126f), far(limit);
  for (int j = 0; j < 3; ++j) {
    const Vec8 axis = axisOf(boxes, j);
    // Along the axis, the ray is between -half and half from the reach -(from + half) / speed to (half -
    // from) / speed; the other way round if it descends.
    const Float8 along = dot(axis, direction), from = dot(axis, offset);
    const Float8 least(0x1p-30f);
    const Float8 inverse = Float8(1.0f) / select(abs(along), least, least, along);
    const Float8 half = Float8::load(boxes.half_extents[j]) + Float8(ray.slack);
    const Float8 middle = from * inverse, width = half * abs(inverse);
    near = max(near, Float8(0.0f) - (middle + width));
    far = min(far, width - middle);
  }
  near.store(reaches);
  return kAllLanes & ~less(far, near);
}

/// A ray in a frame in which it is the z axis: the axis nearest to the ray stays, and x and y are sheared (S.
/// Woop, C. Benthin, I. Wald, Watertight Ray/Triangle Intersection, 2013).
struct ShearedRay {
  int x, y, z;
  float shear_x, shear_y;
  float inverse_z;
  float slack;
  std::array<float, 3> origin;

  /// The ray in the frame of a box.
  ShearedRay(const LocalRay& ray, const Box8& boxes, std::uint32_t lane) : slack(ray.slack) {
    float direction[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      direction[axis] = origin[axis] = 0.0f;
      for (std::size_t i = 0; i < 3; ++i) {
        const float along = boxes.axes[i][axis][lane];
        direction[axis] += along * ray.direction[i];
        origin[axis] += along * (ray.origin[i] - boxes.center[i][lane]);
      }
    }
    const auto size = [&](int i) { return std::abs(direction[i]); };
    z = size(0) > size(1) ? (size(0) > size(2) ? 0 : 2) : (size(1) > size(2) ? 1 : 2);
    x = (z + 1) % 3;
    y = (z + 2) % 3;
    inverse_z = 1.0f / direction[z];
    shear_x = direction[x] * inverse_z;
    shear_y = direction[y] * inverse_z;
  }
};

/// A bit for each of a leaf's triangles, given by the rows of their corners, that the ray may cross at a
/// reach of 0 to `limit`. Bits beyond their count are arbitrary.
HWY_INLINE unsigned mayCross(const float* rows, std::size_t count, const ShearedRay& ray, float limit) {
  Vec8 corner[3];
  Float8 size(0.0f);
  for (std::size_t v = 0; v < 3; ++v) {
    const auto component = [&](int i) HWY_ATTR {
      const auto k = static_cast<std::size_t>(i);
      return Float8::load(rows + (3 * v + k) * count) - Float8(ray.origin[k]);
    };
    corner[v].z = component(ray.z);
    corner[v].x = component(ray.x) - Float8(ray.shear_x) * corner[v].z;
    corner[v].y = component(ray.y) - Float8(ray.shear_y) * corner[v].z;
    size = size + abs(corner[v].x) + abs(corner[v].y);
  }
  Float8 least(0.0f), greatest(0.0f);
  for (std::size_t v = 0; v < 3; ++v) {
    const Vec8 &a = corner[v], &b = corner[(v + 1) % 3];
    const Float8 side = a.x * b.y - a.y * b.x;
    least = min(least, side);
    greatest = max(greatest, side);
  }
  // The errors of x and y are less than the slack.
  const Float8 slack(ray.slack);
  const Float8 tolerance = slack * (Float8(2.0f) * slack + size) + Float8(0x1p-120f);
  const unsigned outside = less(least, Float8(0.0f) - tolerance) & less(tolerance, greatest);
  const Float8 inverse_z(ray.inverse_z);
  const Float8 reach[3] = {corner[0].z * inverse_z, corner[1].z * inverse_z, corner[2].z * inverse_z};
  const Float8 nearest = min(reach[0], min(reach[1], reach[2]));
  const Float8 farthest = max(reach[0], max(reach[1], reach[2]));
  const unsigned out_of_reach = less(Float8(limit), nearest) | less(farthest, Float8(0.0f) - slack);
  return ~(outside | out_of_reach);
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
