#include "render/flow_chart.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "io/markup_text.h"
#include "io/new_file.h"

namespace octoblisk::demos {
namespace {

// Pixels.
constexpr double kBoxWidth = 300.0, kBoxHeight = 74.0, kGap = 40.0, kBorder = 20.0;
constexpr double kLineHeight = 18.0, kPoint = 18.0;  // kPoint: of a decision's pointed ends
constexpr std::size_t kLineLength = 36;              // characters

struct BoxPlace {
  double x = 0.0, y = 0.0;  // of the box's centre

  double top() const { return y - 0.5 * kBoxHeight; }
  double bottom() const { return y + 0.5 * kBoxHeight; }
};

BoxPlace placeOf(const FlowBox& box) {
  return {kBorder + 0.5 * kBoxWidth + box.column * (kBoxWidth + kGap),
          kBorder + 0.5 * kBoxHeight + box.row * (kBoxHeight + kGap)};
}

void requireUsable(const FlowChart& chart) {
  if (chart.boxes.empty()) throw std::invalid_argument("a flow chart needs a box");
  for (const FlowBox& box : chart.boxes) {
    if (!(box.column >= 0.0) || box.row < 0) {
      throw std::invalid_argument("box '" + box.text + "' is outside the chart");
    }
  }
  for (const FlowArrow& arrow : chart.arrows) {
    const std::size_t count = chart.boxes.size();
    if (arrow.from >= count || arrow.to >= count ||
        chart.boxes[arrow.from].row >= chart.boxes[arrow.to].row) {
      throw std::invalid_argument("an arrow must go down from box to box: " + std::to_string(arrow.from) +
                                  " to " + std::to_string(arrow.to));
    }
  }
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (lines.empty() || lines.back().size() + 1 + word.size() > kLineLength) {
      lines.push_back(word);
    } else {
      lines.back() += ' ' + word;
    }
  }
  return lines;
}

void draw(const FlowBox& box, std::ostream& svg) {
  const BoxPlace place = placeOf(box);
  const double left = place.x - 0.5 * kBoxWidth, right = place.x + 0.5 * kBoxWidth;
  if (box.shape == FlowShape::step) {
    svg << "<rect x=\"" << left << "\" y=\"" << place.top() << "\" width=\"" << kBoxWidth << "\" height=\""
        << kBoxHeight << "\" rx=\"6\" fill=\"#eef1f4\"/>\n";
  } else {
    svg << "<polygon points=\"" << left << ',' << place.y << ' ' << left + kPoint << ',' << place.top() << ' '
        << right - kPoint << ',' << place.top() << ' ' << right << ',' << place.y << ' ' << right - kPoint
        << ',' << place.bottom() << ' ' << left + kPoint << ',' << place.bottom()
        << "\" fill=\"#fff4dc\"/>\n";
  }
  const std::vector<std::string> lines = linesOf(box.text);
  double y = place.y + 5.0 - 0.5 * kLineHeight * (static_cast<double>(lines.size()) - 1.0);
  for (const std::string& line : lines) {
    svg << "<text x=\"" << place.x << "\" y=\"" << y << "\">" << markupText(line) << "</text>\n";
    y += kLineHeight;
  }
}

/// Down to halfway before the other box, across, and down to the box.
void draw(const FlowArrow& arrow, const FlowChart& chart, std::ostream& svg) {
  const BoxPlace from = placeOf(chart.boxes[arrow.from]), to = placeOf(chart.boxes[arrow.to]);
  const double turn = to.top() - 0.5 * kGap;
  svg << "<path d=\"M" << from.x << ' ' << from.bottom() << " V" << turn << " H" << to.x << " V" << to.top()
      << "\" marker-end=\"url(#tip)\"/>\n";
  if (arrow.label.empty()) return;
  svg << "<text x=\"" << to.x + 8.0 << "\" y=\"" << turn + 13.0 << "\" style=\"text-anchor:start\">"
      << markupText(arrow.label) << "</text>\n";
}

}  // namespace

std::string svgOf(const FlowChart& chart) {
  requireUsable(chart);
  double width = 0.0, height = 0.0;
  for (const FlowBox& box : chart.boxes) {
    width = std::max(width, placeOf(box).x + 0.5 * kBoxWidth + kBorder);
    height = std::max(height, placeOf(box).bottom() + kBorder);
  }
  std::ostringstream svg;
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height
      << "\" viewBox=\"0 0 " << width << ' ' << height << "\">\n"
      << "<style>text{font:14px 'DejaVu Sans',sans-serif;text-anchor:middle;fill:#21262e}"
         "rect,polygon,path{stroke:#5c6675;stroke-width:1.5}path{fill:none}</style>\n"
         "<defs><marker id=\"tip\" viewBox=\"0 0 10 10\" refX=\"9\" refY=\"5\" markerWidth=\"8\" "
         "markerHeight=\"8\" orient=\"auto\"><polygon points=\"0,1 10,5 0,9\" fill=\"#5c6675\"/></marker>"
         "</defs>\n"
         "<rect width=\"100%\" height=\"100%\" style=\"fill:#fff;stroke:none\"/>\n";
  for (const FlowArrow& arrow : chart.arrows) draw(arrow, chart, svg);
  for (const FlowBox& box : chart.boxes) draw(box, svg);
  svg << "</svg>\n";
  return svg.str();
}

void writeSvg(const FlowChart& chart, const std::filesystem::path& file) { writeFile(file, svgOf(chart)); }

}  // namespace octoblisk::demos
