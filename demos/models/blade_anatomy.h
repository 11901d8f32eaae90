// The parts of every blade of a blisk, and the channels between the blades.
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
  /// How far the blade's middle bulges forward off its chord, in chords: the mean over a contour, taken over
  /// the middle of the height. Below 0 it bulges backward.
  double camber = 0.0;
  /// The least distance, at mid height, of this blade's forward side from the next blade's backward side: of
  /// the contours there. The two sides bound a channel.
  double channel_width = 0.0;
};

struct BliskAnatomy {
  BladeSides sides;
  std::vector<BladeAnatomy> blades;      ///< blade 1 first; the next one is at the greater angle
  std::optional<BladeSide> convex_side;  ///< the other one is concave; none: too little camber to tell
};

/// Measures the blades of a blisk, axis Z. The leading edge is that of lesser z, which is a convention: what
/// way the stream goes is not to be seen from a mesh. The convex side is told where the camber is at least
/// 0.3 % of the chord.
/// Throws std::invalid_argument in one line: the blades are not of the mesh, or one has no root, tip or
/// contour.
BliskAnatomy findAnatomy(const TriangleMesh& blisk, const BladesFound& blades);

}  // namespace octoblisk::demos
