// Draws the text around a picture: title, legend, scale bar.
#pragma once

#include <string>
#include <vector>

#include "render/image.h"

namespace octoblisk::demos {

enum class LegendSymbol { surface, line, point };

struct LegendEntry {
  Color color;
  std::string text;  ///< UTF-8
  LegendSymbol symbol = LegendSymbol::surface;
};

struct Annotation {
  std::string title{};     ///< UTF-8; may be empty
  std::string subtitle{};  ///< UTF-8; may be empty
  std::vector<LegendEntry> legend{};
  std::string length_unit{};  ///< of the scale bar, for example "mm"; empty for no scale bar
};

/// The layout of a page: text above, the scene, text below. Nothing overlaps.
class Layout {
 public:
  Layout(const Annotation& annotation, int width, int height);

  /// Pixels per point; a page of 1600 × 1200 pixels has one.
  double scale() const { return scale_; }
  int sceneTop() const { return scene_top_; }
  int sceneHeight() const { return scene_height_; }

  /// A legend entry's symbol: its left end and the middle of its height, in pixels of the page.
  struct Place {
    double left;
    double middle;
  };
  const std::vector<Place>& legendPlaces() const { return legend_places_; }

 private:
  double scale_;
  int scene_top_ = 0;
  int scene_height_;
  std::vector<Place> legend_places_;
};

/// Draws the text on a page that already has the scene. `unit_pixels` is the length in pixels of one mesh
/// unit; `at_depth` is added to the scale bar's label and says where the bar is valid, if not everywhere.
void annotate(Image& page, const Annotation& annotation, const Layout& layout, double unit_pixels,
              const std::string& at_depth);

/// The largest round number 1, 2 or 5 · 10ⁿ not above `length` (> 0).
double roundLength(double length);

/// Writes the image. Throws std::runtime_error naming the path and the reason if it cannot.
void writePng(const Image& image, const std::string& path);

}  // namespace octoblisk::demos
