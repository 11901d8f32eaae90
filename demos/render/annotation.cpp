#include "render/annotation.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "io/new_file.h"

namespace octoblisk::demos {
namespace {

// All lengths are in points of a page of 1600 × 1200.
constexpr double kPageMargin = 44.0;
constexpr double kTitleSize = 34.0;
constexpr double kSubtitleSize = 21.0;
constexpr double kTextSize = 20.0;
constexpr double kTitleGap = 10.0;  // between title, subtitle and scene
constexpr double kLegendRow = 36.0;
constexpr double kSymbolWidth = 30.0;
constexpr double kSymbolHeight = 18.0;
constexpr double kSymbolGap = 11.0;       // between a symbol and its text
constexpr double kEntryGap = 38.0;        // between entries
constexpr double kScaleBarWidth = 240.0;  // greatest
constexpr double kScaleBarRoom = 300.0;   // reserved for the bar and its label

constexpr Color kTextColor{0.11f, 0.13f, 0.16f};
constexpr Color kQuietColor{0.36f, 0.39f, 0.43f};
constexpr Color kRuleColor{0.84f, 0.86f, 0.88f};

struct Release {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, Release>;

/// A Cairo canvas, in points: thin wrappers over its calls.
class Canvas {
 public:
  Canvas(int width, int height, double scale)
      : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
        context_(cairo_create(surface_.get())) {
    if (const auto status = cairo_status(context_.get()); status != CAIRO_STATUS_SUCCESS) {
      throw std::runtime_error(std::string("Cairo failed: ") + cairo_status_to_string(status));
    }
    cairo_scale(context_.get(), scale, scale);
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(context_.get(), options);
    cairo_font_options_destroy(options);
  }

  cairo_t* get() const { return context_.get(); }
  cairo_surface_t* surface() const { return surface_.get(); }

  void setColor(const Color& color) { cairo_set_source_rgb(context_.get(), color.r, color.g, color.b); }

  void setFont(double size, bool bold) {
    cairo_select_font_face(context_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context_.get(), size);
  }

  double textWidth(const std::string& text) const {
    cairo_text_extents_t extents;
    cairo_text_extents(context_.get(), text.c_str(), &extents);
    return extents.x_advance;
  }

  void drawText(const std::string& text, double left, double baseline) {
    cairo_move_to(context_.get(), left, baseline);
    cairo_show_text(context_.get(), text.c_str());
  }

  void drawRule(double height, double width) {
    cairo_move_to(context_.get(), 0.0, height);
    cairo_line_to(context_.get(), width, height);
    cairo_set_line_width(context_.get(), 1.5);
    cairo_stroke(context_.get());
  }

  /// In a smaller size if it would be wider than `room`.
  void drawHeading(const std::string& text, double size, bool bold, double baseline, double room) {
    setFont(size, bold);
    if (const double width = textWidth(text); width > room) setFont(size * room / width, bold);
    drawText(text, kPageMargin, baseline);
  }

 private:
  CairoSurface surface_;
  std::unique_ptr<cairo_t, Release> context_;
};

/// Cairo's pixels are native-endian 0x00RRGGBB.
void copyToCanvas(const Image& image, cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  unsigned char* row_bytes = cairo_image_surface_get_data(surface);
  for (int row = 0; row < image.height; ++row, row_bytes += cairo_image_surface_get_stride(surface)) {
    for (int column = 0; column < image.width; ++column) {
      const Image::Pixel& pixel = image.at(column, row);
      const std::uint32_t word = std::uint32_t{pixel[0]} << 16 | std::uint32_t{pixel[1]} << 8 | pixel[2];
      std::memcpy(row_bytes + sizeof word * column, &word, sizeof word);
    }
  }
  cairo_surface_mark_dirty(surface);
}

void copyFromCanvas(cairo_surface_t* surface, Image& image) {
  cairo_surface_flush(surface);
  const unsigned char* row_bytes = cairo_image_surface_get_data(surface);
  for (int row = 0; row < image.height; ++row, row_bytes += cairo_image_surface_get_stride(surface)) {
    for (int column = 0; column < image.width; ++column) {
      std::uint32_t word = 0;
      std::memcpy(&word, row_bytes + sizeof word * column, sizeof word);
      image.at(column, row) = {static_cast<std::uint8_t>(word >> 16), static_cast<std::uint8_t>(word >> 8),
                               static_cast<std::uint8_t>(word), 255};
    }
  }
}

void drawSymbol(Canvas& canvas, const LegendEntry& entry, double left, double middle) {
  cairo_t* context = canvas.get();
  switch (entry.symbol) {
    case LegendSymbol::surface:
      cairo_rectangle(context, left, middle - 0.5 * kSymbolHeight, kSymbolWidth, kSymbolHeight);
      canvas.setColor(entry.color);
      cairo_fill_preserve(context);
      canvas.setColor(kTextColor);
      cairo_set_line_width(context, 1.5);
      cairo_stroke(context);
      break;
    case LegendSymbol::line:
      cairo_move_to(context, left, middle);
      cairo_line_to(context, left + kSymbolWidth, middle);
      canvas.setColor(entry.color);
      cairo_set_line_width(context, 4.0);
      cairo_stroke(context);
      break;
    case LegendSymbol::point:
      cairo_arc(context, left + 0.5 * kSymbolWidth, middle, 0.5 * kSymbolHeight, 0.0, 2.0 * std::numbers::pi);
      canvas.setColor(entry.color);
      cairo_fill(context);
      break;
  }
}

/// Right-aligned at `right`, its line at `middle`.
void drawScaleBar(Canvas& canvas, const std::string& unit, const std::string& at_depth, double unit_points,
                  double right, double middle) {
  constexpr double kTick = 7.0;
  const double length = roundLength(kScaleBarWidth / unit_points);
  const double left = right - length * unit_points;
  std::ostringstream label;
  label << length << ' ' << unit << at_depth;

  cairo_t* context = canvas.get();
  canvas.setColor(kTextColor);
  cairo_set_line_width(context, 2.5);
  cairo_move_to(context, left, middle - kTick);
  cairo_line_to(context, left, middle + kTick);
  cairo_move_to(context, left, middle);
  cairo_line_to(context, right, middle);
  cairo_move_to(context, right, middle - kTick);
  cairo_line_to(context, right, middle + kTick);
  cairo_stroke(context);
  canvas.setFont(kTextSize, false);
  const double label_width = canvas.textWidth(label.str());
  canvas.drawText(label.str(), std::min(0.5 * (left + right - label_width), right - label_width),
                  middle - 14.0);
}

}  // namespace

double roundLength(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= length) return factor * power;
  }
  return power;
}

Layout::Layout(const Annotation& annotation, int width, int height)
    : scale_(std::min(width / 1600.0, height / 1200.0)) {
  double top = 0.0;
  if (!annotation.title.empty()) top += kTitleSize + kTitleGap;
  if (!annotation.subtitle.empty()) top += kSubtitleSize + kTitleGap;
  if (top > 0.0) top += 0.5 * kPageMargin + kTitleGap;

  // Entries flow from left to right, row by row, beside the space of the scale bar.
  Canvas ruler(1, 1, 1.0);
  ruler.setFont(kTextSize, false);
  const bool has_bar = !annotation.length_unit.empty();
  const double right_end = width / scale_ - kPageMargin - (has_bar ? kScaleBarRoom : 0.0);
  double left = kPageMargin;
  int rows = annotation.legend.empty() ? 0 : 1;
  for (const LegendEntry& entry : annotation.legend) {
    const double entry_width = kSymbolWidth + kSymbolGap + ruler.textWidth(entry.text);
    if (left > kPageMargin && left + entry_width > right_end) {
      left = kPageMargin;
      ++rows;
    }
    legend_places_.push_back({left, (rows - 0.5) * kLegendRow});
    left += entry_width + kEntryGap;
  }
  const double words_height = std::max(rows * kLegendRow, has_bar ? 1.3 * kLegendRow : 0.0);
  const double bottom = words_height > 0.0 ? words_height + kPageMargin : 0.0;
  const double words_top = height / scale_ - 0.6 * kPageMargin - words_height;
  for (Place& place : legend_places_) place = {place.left * scale_, (place.middle + words_top) * scale_};

  scene_top_ = std::min(static_cast<int>(std::lround(top * scale_)), height - 1);
  scene_height_ = std::max(1, height - scene_top_ - static_cast<int>(std::lround(bottom * scale_)));
}

void annotate(Image& page, const Annotation& annotation, const Layout& layout, double unit_pixels,
              const std::string& at_depth) {
  const double scale = layout.scale();
  const double page_width = page.width / scale;
  const double page_height = page.height / scale;
  Canvas canvas(page.width, page.height, scale);
  copyToCanvas(page, canvas.surface());

  // A line between the scene and the text.
  canvas.setColor(kRuleColor);
  const double scene_top = layout.sceneTop() / scale;
  const double scene_bottom = (layout.sceneTop() + layout.sceneHeight()) / scale;
  if (scene_top > 0.0) canvas.drawRule(scene_top, page_width);
  if (scene_bottom < page_height) canvas.drawRule(scene_bottom, page_width);

  double baseline = 0.5 * kPageMargin;
  const double room = page_width - 2.0 * kPageMargin;
  if (!annotation.title.empty()) {
    baseline += kTitleSize;
    canvas.setColor(kTextColor);
    canvas.drawHeading(annotation.title, kTitleSize, true, baseline, room);
    baseline += kTitleGap;
  }
  if (!annotation.subtitle.empty()) {
    baseline += kSubtitleSize;
    canvas.setColor(kQuietColor);
    canvas.drawHeading(annotation.subtitle, kSubtitleSize, false, baseline, room);
  }

  canvas.setFont(kTextSize, false);
  for (std::size_t index = 0; index < annotation.legend.size(); ++index) {
    const double left = layout.legendPlaces()[index].left / scale;
    const double middle = layout.legendPlaces()[index].middle / scale;
    drawSymbol(canvas, annotation.legend[index], left, middle);
    canvas.setColor(kTextColor);
    canvas.drawText(annotation.legend[index].text, left + kSymbolWidth + kSymbolGap,
                    middle + 0.36 * kTextSize);
  }
  if (!annotation.length_unit.empty()) {
    drawScaleBar(canvas, annotation.length_unit, at_depth, unit_pixels / scale, page_width - kPageMargin,
                 page_height - 0.6 * kPageMargin - 0.5 * kLegendRow);
  }
  copyFromCanvas(canvas.surface(), page);
}

void writePng(const Image& image, const std::string& path) {
  Canvas canvas(image.width, image.height, 1.0);
  copyToCanvas(image, canvas.surface());
  std::string bytes;
  const auto append = [](void* to, const unsigned char* data, unsigned size) {
    static_cast<std::string*>(to)->append(data, data + size);
    return CAIRO_STATUS_SUCCESS;
  };
  const cairo_status_t status = cairo_surface_write_to_png_stream(canvas.surface(), append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(path + ": cannot be opened for drawing: " + cairo_status_to_string(status));
  }
  writeFile(path, bytes);
}

}  // namespace octoblisk::demos
