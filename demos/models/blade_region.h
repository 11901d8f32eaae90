// The regions of a blade's surface that a path grinds: the two sides and the two edges.
#pragma once

#include "models/contour_line.h"

namespace octoblisk::demos {

/// The sides are those of BladeSide and run from edge to edge. An edge's region reaches to either side of it.
enum class BladeRegion { forward, backward, leading_edge, trailing_edge };

inline bool isEdge(BladeRegion region) {
  return region == BladeRegion::leading_edge || region == BladeRegion::trailing_edge;
}

/// The reach of an edge's region to either side, unless another one is asked for, mm along the surface.
inline constexpr double kEdgeReach = 3.0;

/// The section of a contour in a region: on a side from the leading to the trailing edge, around an edge from
/// the backward to the forward side. `edge_reach` (mm) is for edges only. Throws std::invalid_argument if it
/// exceeds the width of a side.
ContourLine regionLine(const BladeContour& contour, BladeRegion region, double edge_reach);

}  // namespace octoblisk::demos
