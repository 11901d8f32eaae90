// Lower bounds of the distance between an oriented box, or a point, and eight boxes. Included once for each
// target (simd-inl.h).
#if defined(OCTOBLISK_SIMD_BOX_GAP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_SIMD_BOX_GAP_INL_H
#undef OCTOBLISK_SIMD_BOX_GAP_INL_H
#else
#define OCTOBLISK_SIMD_BOX_GAP_INL_H
#endif

#include "simd/box8.h"
#include "simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// One of the eight boxes, transformed by a pose.
HWY_INLINE BoxF posed(const PoseF& pose, const Box8& boxes, std::uint32_t lane) {
  BoxF box;
  for (int i = 0; i < 3; ++i) {
    const auto rotated = [&](const auto& vector) HWY_ATTR {
      return pose.rotation(i, 0) * vector(0) + pose.rotation(i, 1) * vector(1) +
             pose.rotation(i, 2) * vector(2);
    };
    box.center[i] = rotated([&](int k) HWY_ATTR { return boxes.center[k][lane]; }) + pose.translation[i];
    for (int j = 0; j < 3; ++j)
      box.axes(i, j) = rotated([&](int k) HWY_ATTR { return boxes.axes[k][j][lane]; });
    box.half_extents[i] = boxes.half_extents[i][lane];
  }
  return box;
}

HWY_INLINE Vec8 centersOf(const Box8& boxes) {
  return {Float8::load(boxes.center[0]), Float8::load(boxes.center[1]), Float8::load(boxes.center[2])};
}

HWY_INLINE Vec8 axisOf(const Box8& boxes, int j) {
  return {Float8::load(boxes.axes[0][j]), Float8::load(boxes.axes[1][j]), Float8::load(boxes.axes[2][j])};
}

/// Calls visit(axis, radius) for the three face axes of `box`, then for those of each of the eight boxes. The
/// radius is the sum of the extents of both boxes along the axis, to one side.
template <typename Visit>
HWY_INLINE void forEachFaceAxis(const Box8& boxes, const BoxF& box, Visit&& visit) {
  Vec8 axis_of_boxes[3];
  Float8 half_extents[3], radius_along_boxes[3];
  for (int j = 0; j < 3; ++j) {
    axis_of_boxes[j] = axisOf(boxes, j);
    half_extents[j] = radius_along_boxes[j] = Float8::load(boxes.half_extents[j]);
  }
  for (int i = 0; i < 3; ++i) {
    const Vec8 axis = Vec8::all(box.axes.col(i));
    Float8 radius(box.half_extents[i]);
    for (int j = 0; j < 3; ++j) {
      const Float8 cosine = abs(dot(axis_of_boxes[j], axis));
      radius = radius + half_extents[j] * cosine;
      radius_along_boxes[j] = radius_along_boxes[j] + Float8(box.half_extents[i]) * cosine;
    }
    visit(axis, radius);
  }
  for (int j = 0; j < 3; ++j) visit(axis_of_boxes[j], radius_along_boxes[j]);
}

/// The gaps between each of the eight boxes and `box` along their six face axes; negative if the two overlap
/// along the axis. The nine edge axes are not tested.
struct FaceGaps {
  Float8 along[6];  ///< first the axes of the single box, then those of each of the eight boxes
};

HWY_INLINE FaceGaps faceGaps(const Box8& boxes, const BoxF& box) {
  FaceGaps gaps;
  const Vec8 between = centersOf(boxes) - Vec8::all(box.center);
  int axes = 0;
  forEachFaceAxis(boxes, box, [&](const Vec8& axis, const Float8& radius) HWY_ATTR {
    gaps.along[axes++] = abs(dot(axis, between)) - radius;
  });
  return gaps;
}

/// The widest of the six gaps. If it is above 0, the two boxes are at least that far apart; otherwise they
/// may overlap.
HWY_INLINE Float8 widestGap(const Box8& boxes, const BoxF& box) {
  const FaceGaps gaps = faceGaps(boxes, box);
  return max(max(max(gaps.along[0], gaps.along[1]), gaps.along[2]),
             max(max(gaps.along[3], gaps.along[4]), gaps.along[5]));
}

/// widestGap as a function object for traversals.
struct WidestGap {
  HWY_INLINE Float8 operator()(const Box8& boxes, const BoxF& box) const { return widestGap(boxes, box); }
};

/// Lower bounds of the distances of the eight boxes to the centre of `box`, for traversals with a point.
/// Infinite for empty boxes.
struct GapOfPoint {
  HWY_INLINE Float8 operator()(const Box8& boxes, const BoxF& box) const {
    const Vec8 offset = Vec8::all(box.center) - centersOf(boxes);
    Float8 squared(0.0f);
    for (int j = 0; j < 3; ++j) {
      const Float8 outside =
          max(abs(dot(axisOf(boxes, j), offset)) - Float8::load(boxes.half_extents[j]), Float8(0.0f));
      squared = squared + outside * outside;
    }
    return sqrt(squared) - Float8(0x1p-74f);  // squares of subnormal numbers may have been rounded up
  }
};

/// A lower bound of the squared distances of the eight boxes to `box`.
HWY_INLINE Float8 squaredDistanceBound(const Box8& boxes, const BoxF& box) {
  const FaceGaps gaps = faceGaps(boxes, box);
  const auto squared = [](const Float8 gap[3]) HWY_ATTR {
    const Float8 zero(0.0f);
    const Vec8 apart{max(gap[0], zero), max(gap[1], zero), max(gap[2], zero)};
    return dot(apart, apart);
  };
  return max(squared(gaps.along), squared(gaps.along + 3));
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
