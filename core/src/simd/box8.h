// Oriented boxes in single precision: single ones, and eight side by side.
#pragma once

#include <algorithm>
#include <cstdint>

#include "octoblisk/types.h"

namespace octoblisk::detail {

inline constexpr int kLanes = 8;
inline constexpr unsigned kAllLanes = 0xff;

/// How far products of a box's axes may be from 0 and 1: 16 units in the last place. leaf_pair-inl.h relies
/// on it.
inline constexpr double kOrthonormal = 0x1p-20;

/// An oriented box in single precision, in the local frame of a tree.
struct BoxF {
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();
  Eigen::Vector3f half_extents = Eigen::Vector3f::Zero();
};

/// The box in the mesh's frame, in which the tree's origin is at `origin`.
inline Obb inMesh(const BoxF& box, const Vec3& origin) {
  return {box.center.cast<double>() + origin, box.axes.cast<double>(), box.half_extents.cast<double>()};
}

/// Axes, or a rotation, in single precision. Components whose products would be subnormal become zero: they
/// are far below the rounding of the others, and subnormal arithmetic takes a processor a hundred times as
/// long.
inline Eigen::Matrix3f inSinglePrecision(const Mat3& axes) {
  constexpr float kLeast = 1e-18f;
  const Eigen::Matrix3f single = axes.cast<float>();
  return (single.array().abs() < kLeast).select(0.0f, single);
}

/// A rigid motion in single precision.
struct PoseF {
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;

  explicit PoseF(const Pose& pose)
      : rotation(inSinglePrecision(pose.rotation)), translation(pose.translation.cast<float>()) {}
  BoxF operator*(const BoxF& box) const {
    return {rotation * box.center + translation, rotation * box.axes, box.half_extents};
  }
};

/// Eight oriented boxes, each quantity of all eight in a row, so that they can be tested at once
/// (box_gap-inl.h). The axes of each box are in descending order of half extents.
struct Box8 {
  float center[3][kLanes];
  float half_extents[3][kLanes];
  float axes[3][3][kLanes];  ///< [component][axis]

  static constexpr float kEmptyHalfExtent = -1e30f;

  /// Eight empty boxes: nothing overlaps them.
  Box8() {
    const BoxF empty{Eigen::Vector3f::Zero(), Eigen::Matrix3f::Identity(),
                     Eigen::Vector3f::Constant(kEmptyHalfExtent)};
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) set(lane, empty);
  }

  /// Eight uninitialised boxes: a buffer that is written before it is read.
  struct Unset {};
  explicit Box8(Unset) {}

  void set(std::uint32_t lane, const BoxF& box) {
    int order[3] = {0, 1, 2};
    std::sort(order, order + 3, [&](int i, int j) { return box.half_extents[i] > box.half_extents[j]; });
    const bool odd = (order[1] - order[0] + 3) % 3 == 2;
    for (int j = 0; j < 3; ++j) {
      const float sign = odd && j == 2 ? -1.0f : 1.0f;  // stays right-handed
      center[j][lane] = box.center[j];
      half_extents[j][lane] = box.half_extents[order[j]];
      for (int i = 0; i < 3; ++i) axes[i][j][lane] = sign * box.axes(i, order[j]);
    }
  }

  BoxF get(std::uint32_t lane) const {
    BoxF box;
    for (int i = 0; i < 3; ++i) {
      box.center[i] = center[i][lane];
      box.half_extents[i] = half_extents[i][lane];
      for (int j = 0; j < 3; ++j) box.axes(i, j) = axes[i][j][lane];
    }
    return box;
  }

  float largestHalfExtent(std::uint32_t lane) const { return half_extents[0][lane]; }
};

}  // namespace octoblisk::detail
