#include "tree/compact_node.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tree/node_boxes-inl.h"  // for the one target that all code is compiled for

namespace octoblisk::detail {

CompactRotation compactRotation(const Eigen::Matrix3f& axes) {
  const Eigen::Vector4d q = Eigen::Quaterniond(axes.cast<double>().eval()).coeffs();
  const double largest = q.cwiseAbs().maxCoeff();
  // The quaternion may have any length. Choose the length whose decoded axes have the least rounding error.
  constexpr int kLongest = std::numeric_limits<std::int16_t>::max(), kLengths = 64;
  CompactRotation best = {};
  constexpr double kGoodEnough = 0x1p-22;
  double least = std::numeric_limits<double>::infinity();
  for (int length = kLongest; length > kLongest - kLengths && least > kGoodEnough; --length) {
    CompactRotation rotation;
    for (int k = 0; k < 4; ++k)
      rotation[static_cast<std::size_t>(k)] = static_cast<std::int16_t>(std::lround(length / largest * q[k]));
    const Mat3 read = decoded(rotation).cast<double>();
    const double off = (read.transpose() * read - Mat3::Identity()).cwiseAbs().maxCoeff();
    if (off < least) {
      least = off;
      best = rotation;
    }
  }
  return best;
}

// With HWY_ATTR, axesOf can be inlined: on ARM64 Highway compiles it for more than the other code.
HWY_ATTR Eigen::Matrix3f decoded(const CompactRotation& rotation) {
  float q[4], axes[3][3];
  for (std::size_t k = 0; k < 4; ++k) q[k] = rotation[k];
  HWY_NAMESPACE::axesOf(q, axes);
  Eigen::Matrix3f matrix;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) matrix(i, j) = axes[i][j];
  }
  return matrix;
}

BoxF CompactNode::box(std::uint32_t lane) const {
  Box8 room(Box8::Unset{});
  HWY_NAMESPACE::decode(*this, lane, room);
  return room.get(lane);
}

void CompactNode::setBoxes(const std::array<CompactRotation, kLanes>& rotations,
                           const std::array<BoxF, kLanes>& boxes, float pad) {
  Aabb centers;
  double largest = 0.0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (children[lane].isEmpty()) continue;
    centers.extend(boxes[lane].center.cast<double>());
    largest = std::max(largest, double(boxes[lane].half_extents.maxCoeff()) + double(pad));
  }
  const Eigen::Vector3f middle = centers.center().cast<float>();
  const Vec3 reach = (centers.max - middle.cast<double>()).cwiseMax(middle.cast<double>() - centers.min);
  // Both leave room for rounding to integers.
  constexpr double kFarthest = 32766.0, kLargest = 65500.0;
  scale = static_cast<float>(std::max(
      {reach.maxCoeff() / kFarthest, largest / kLargest, double(std::numeric_limits<float>::min())}));
  for (int k = 0; k < 3; ++k) origin[k] = middle[k];

  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    if (children[lane].isEmpty()) continue;
    for (std::size_t k = 0; k < 4; ++k) rotation[k][lane] = rotations[lane][k];
    for (int k = 0; k < 3; ++k) {
      const double offset = double(boxes[lane].center[k]) - double(origin[k]);
      center[k][lane] = static_cast<std::int16_t>(std::lround(offset / double(scale)));
    }
    const BoxF read = box(lane);
    const Vec3 shift = read.axes.cast<double>().transpose() *
                       (boxes[lane].center.cast<double>() - read.center.cast<double>());
    std::uint16_t at_least = 1;  // at least the next one, because half extents are in descending order
    for (int k = 3; k-- > 0;) {
      const double needed = double(boxes[lane].half_extents[k]) + double(pad) + std::abs(shift[k]);
      auto units = static_cast<std::uint16_t>(std::ceil(needed / double(scale)));
      while (double(scale * static_cast<float>(units)) < needed) ++units;
      half_extents[k][lane] = at_least = std::max(units, at_least);
    }
  }
}

}  // namespace octoblisk::detail
