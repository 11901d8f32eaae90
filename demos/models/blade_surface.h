// The surface of one blade, from the hub surface to its tip, as a grid of points.
#pragma once

#include <vector>

#include "models/blade_sections.h"
#include "models/radius_profile.h"

namespace octoblisk::demos {

/// A point about the Z axis, in mm and radians that are not wrapped to one turn.
struct CylindricalPoint {
  double z = 0.0;
  double radius = 0.0;
  double angle = 0.0;
};

Vec3 toCartesian(const CylindricalPoint& point);

/// The two sides of a blade: kForward faces towards greater angles, kBackward towards lesser ones.
enum class BladeSide { forward, backward };

/// Points of a blade by side, row (0 at the hub … span_cells at the tip) and station (0 at the leading edge
/// … chord_cells at the trailing edge). Both sides have identical points at either edge.
class BladeGrid {
 public:
  BladeGrid(int chord_cells, int span_cells);

  int chordCells() const { return chord_cells_; }
  int spanCells() const { return span_cells_; }
  CylindricalPoint& at(BladeSide side, int row, int station) { return points_[index(side, row, station)]; }
  const CylindricalPoint& at(BladeSide side, int row, int station) const {
    return points_[index(side, row, station)];
  }

 private:
  std::size_t index(BladeSide side, int row, int station) const {
    const int side_and_row = (side == BladeSide::forward ? 0 : span_cells_ + 1) + row;
    return static_cast<std::size_t>(side_and_row) * (chord_cells_ + 1) + station;
  }

  int chord_cells_;
  int span_cells_;
  std::vector<CylindricalPoint> points_;
};

/// Resamples sections into a grid: along each section from its point of least z to that of greatest z with
/// cosine spacing, then smoothly across the sections, and from the hub surface up in equal steps. Sections
/// inside the hub are clipped to it; if the first section is slightly outside, the blade is extended to the
/// hub. The last row is the last section or, with a shroud, lies on the shroud's inner surface.
///
/// Throws std::invalid_argument: a section with undefined edges, a tip below the hub, a blade that starts too
/// far outside the hub or does not reach the shroud, a blade that does not rise from row to row.
BladeGrid sampleBlade(const BladeSections& sections, const RadiusProfile& hub, const RadiusProfile* shroud,
                      int chord_cells, int span_cells);

}  // namespace octoblisk::demos
