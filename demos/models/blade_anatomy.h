// Measures the parts of every blade of a blisk, and the channels between the blades.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "models/blade_contours.h"
#include "models/blade_sides.h"
#include "models/blade_surface.h"

namespace octoblisk::demos {

/// One blade. Lengths in mesh units, points in the blisk's frame.
struct BladeAnatomy {
  double angle = 0.0;                   ///< of the leading edge at the tip, radians in [0, 2π)
  std::vector<Vec3> leading, trailing;  ///< the edges, root to tip, at equal steps of height
  std::size_t triangles = 0;
  double forward_area = 0.0, backward_area = 0.0, tip_area = 0.0;
  /// The forward bulge of the blade's middle line off its chord, in chords: the mean over a contour and over
  /// the middle of the height. A negative value is a backward bulge.
  double camber = 0.0;
  /// The least distance, at mid height, between the contours of this blade's forward side and the next
  /// blade's backward side. The two sides bound a channel.
  double channel_width = 0.0;
};

struct BliskAnatomy {
  BladeSides sides;
  std::vector<BladeAnatomy> blades;      ///< blade 1 first; the next one is at the greater angle
  std::optional<BladeSide> convex_side;  ///< the other side is concave; none if the camber is too small
};

/// Measures the blades of a blisk with the axis Z. By convention the leading edge is the one of lesser z,
/// because a mesh does not show the direction of flow. The convex side is determined if the camber is at
/// least 0.3 % of the chord. Throws std::invalid_argument with a one-line message: the blades are not for
/// this mesh, or one has no root, tip or contour.
BliskAnatomy findAnatomy(const TriangleMesh& blisk, const BladesFound& blades);

}  // namespace octoblisk::demos
