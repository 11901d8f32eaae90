// Chooses the lines over a blade's side that passes follow.
#pragma once

#include <cstddef>
#include <vector>

#include "plan/tool_posture.h"

namespace octoblisk::demos {

/// The centres of the cells of a side's grid (side_grid.h), row by row, root to tip.
struct SurfaceGrid {
  std::size_t rows = 0, columns = 0;
  std::vector<SurfacePoint> points;
};

/// Cells in the order of a pass.
using PassLine = std::vector<std::size_t>;

/// The width that a belt grinds on a surface that is curved along the wheels' axis (1/mm; above 0: convex),
/// if it is pressed in by `depth` (mm) where it is deepest. On a hollow surface the belt rests on its two
/// edges: the width that one of them grinds.
double groundWidth(double curvature, double belt_width, double depth);

struct PassWidth {
  double belt_width = 0.0, scallop = 0.0;  ///< mm; the scallop is the greatest height of the ridges
  double part = 1.0;                       ///< the distance between passes, in widths that a pass grinds
};

/// Lines along columns (`towards_tip`) or rows, so close that passes on them reach each cell that is
/// `wanted`. A line has only the stretches beside such cells; it goes on over a gap below the width of the
/// belt. Every other line runs back.
std::vector<PassLine> passLines(const SurfaceGrid& grid, const std::vector<bool>& wanted, bool towards_tip,
                                const PassWidth& width);

}  // namespace octoblisk::demos
