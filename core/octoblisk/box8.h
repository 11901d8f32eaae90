// Eight oriented boxes side by side, tested at once against one.
//
// Every operation runs over eight lanes of adjacent floats, so that the compiler turns it into vector code.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "octoblisk/types.h"

namespace octoblisk {

inline constexpr int kLanes = 8;
using Float8 = Eigen::Array<float, kLanes, 1>;

/// An oriented box in single precision, in the local frame of a tree.
struct BoxF {
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();
  Eigen::Vector3f half_extents = Eigen::Vector3f::Zero();
};

/// A rigid motion in single precision.
struct PoseF {
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;

  explicit PoseF(const Pose& pose)
      : rotation(pose.rotation.cast<float>()), translation(pose.translation.cast<float>()) {}
  BoxF operator*(const BoxF& box) const {
    return {rotation * box.center + translation, rotation * box.axes, box.half_extents};
  }
};

struct Box8 {
  Float8 center[3];
  Float8 half_extents[3];
  Float8 axes[3][3];  ///< [component][axis]

  /// Eight empty boxes: nothing overlaps them.
  Box8() {
    for (int i = 0; i < 3; ++i) {
      center[i].setZero();
      half_extents[i].setConstant(-1e30f);
      for (int j = 0; j < 3; ++j) axes[i][j].setConstant(i == j ? 1.0f : 0.0f);
    }
  }

  void set(int lane, const BoxF& box) {
    for (int i = 0; i < 3; ++i) {
      center[i][lane] = box.center[i];
      half_extents[i][lane] = box.half_extents[i];
      for (int j = 0; j < 3; ++j) axes[i][j][lane] = box.axes(i, j);
    }
  }

  BoxF get(int lane) const {
    BoxF box;
    for (int i = 0; i < 3; ++i) {
      box.center[i] = center[i][lane];
      box.half_extents[i] = half_extents[i][lane];
      for (int j = 0; j < 3; ++j) box.axes(i, j) = axes[i][j][lane];
    }
    return box;
  }

  float largestHalfExtent(int lane) const {
    return std::max({half_extents[0][lane], half_extents[1][lane], half_extents[2][lane]});
  }
};

/// For each of the eight boxes the widest gap to `box` along the six face axes of the two: where it is above
/// 0, they are apart at least that far; where it is not, they may overlap (the nine edge axes are left out).
inline Float8 widestGap(const Box8& boxes, const BoxF& box) {
  Float8 offset[3], gap = Float8::Constant(-1e30f);
  Float8 cosine[3][3], magnitude[3][3];  // [axis of box][axis of boxes]
  for (int i = 0; i < 3; ++i) {
    const Float8 x = boxes.center[0] - box.center[0], y = boxes.center[1] - box.center[1],
                 z = boxes.center[2] - box.center[2];
    offset[i] = x * box.axes(0, i) + y * box.axes(1, i) + z * box.axes(2, i);
    for (int j = 0; j < 3; ++j) {
      cosine[i][j] = boxes.axes[0][j] * box.axes(0, i) + boxes.axes[1][j] * box.axes(1, i) +
                     boxes.axes[2][j] * box.axes(2, i);
      magnitude[i][j] = cosine[i][j].abs();
    }
    const Float8 radius = boxes.half_extents[0] * magnitude[i][0] + boxes.half_extents[1] * magnitude[i][1] +
                          boxes.half_extents[2] * magnitude[i][2] + box.half_extents[i];
    gap = gap.max(offset[i].abs() - radius);
  }
  for (int j = 0; j < 3; ++j) {
    const Float8 along = offset[0] * cosine[0][j] + offset[1] * cosine[1][j] + offset[2] * cosine[2][j];
    const Float8 radius = box.half_extents[0] * magnitude[0][j] + box.half_extents[1] * magnitude[1][j] +
                          box.half_extents[2] * magnitude[2][j] + boxes.half_extents[j];
    gap = gap.max(along.abs() - radius);
  }
  return gap;
}

}  // namespace octoblisk
