// Draws a map of a blade's side: coloured cells over arc length and height.
#pragma once

#include <span>

#include "render/annotation.h"
#include "render/image.h"

namespace octoblisk::demos {

/// Lengths in mm: along the side from the leading edge, and above the root.
struct MapCell {
  double arc = 0.0, height = 0.0;  ///< of its centre
  double half_width = 0.0, half_height = 0.0;
  Color color;
};

/// The cells, as large as possible, with the annotation around them. Without cells, an empty map.
Image sideMap(std::span<const MapCell> cells, const Annotation& annotation, int width, int height);

}  // namespace octoblisk::demos
