// Eight oriented boxes in 208 bytes: 16-bit integers relative to the node's origin and scale.
#pragma once

#include <array>
#include <cstdint>

#include "simd/box8.h"
#include "tree/child.h"

namespace octoblisk::detail {

/// A rotation as a quaternion x, y, z, w of any length but 0.
using CompactRotation = std::array<std::int16_t, 4>;

/// The rotation nearest to an orthonormal, right-handed frame.
CompactRotation compactRotation(const Eigen::Matrix3f& axes);

/// I − s·(…) with s = 2/|q|²: as orthonormal as single precision allows, whatever the integers are.
Eigen::Matrix3f decoded(const CompactRotation& rotation);

/// Up to eight boxes and their contents. Initially all are empty.
struct alignas(16) CompactNode {
  std::int16_t center[3][kLanes] = {};         ///< relative to the origin, in units of the scale
  std::uint16_t half_extents[3][kLanes] = {};  ///< in that unit, in descending order; 0 for an empty box
  std::int16_t rotation[4][kLanes] = {};
  std::array<Child, kLanes> children;
  float origin[3] = {};
  float scale = 0.0f;

  CompactNode() {
    for (std::int16_t& w : rotation[3]) w = 1;  // decodes to the identity
  }

  CompactRotation rotationOf(std::uint32_t lane) const {
    return {rotation[0][lane], rotation[1][lane], rotation[2][lane], rotation[3][lane]};
  }

  /// The box that the lane's integers represent. The boxes of node_boxes-inl.h are the same to the last bit.
  BoxF box(std::uint32_t lane) const;

  /// Writes the boxes of all lanes that have a child, each in the frame of its compact rotation. Each decoded
  /// box contains the given box with at least `pad` to spare on each side.
  void setBoxes(const std::array<CompactRotation, kLanes>& rotations, const std::array<BoxF, kLanes>& boxes,
                float pad);
};
static_assert(sizeof(CompactNode) == 208);

}  // namespace octoblisk::detail
