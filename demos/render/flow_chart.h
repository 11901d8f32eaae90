// Writes flow charts as SVG files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace octoblisk::demos {

enum class FlowShape { step, question };

/// A box on a grid of columns from the left and rows from the top; k + ½ is between two columns.
struct FlowBox {
  double column = 0.0;
  int row = 0;
  std::string text;  ///< plain UTF-8; wrapped automatically
  FlowShape shape = FlowShape::step;
};

/// From a box down to one in a lower row.
struct FlowArrow {
  std::size_t from = 0, to = 0;  ///< indices of boxes
  std::string label{};           ///< "yes"
};

struct FlowChart {
  std::vector<FlowBox> boxes;
  std::vector<FlowArrow> arrows;
};

/// Throws std::invalid_argument for a chart without boxes, a box left of column 0 or above row 0, and an
/// arrow that has no box at an end or does not go down.
std::string svgOf(const FlowChart& chart);

/// Throws as svgOf, and std::runtime_error naming a file that cannot be written.
void writeSvg(const FlowChart& chart, const std::filesystem::path& file);

}  // namespace octoblisk::demos
