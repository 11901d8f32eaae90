#include "paper/cmm/cmm_plots.h"

#include <algorithm>
#include <string>
#include <utility>

#include "paper/cmm/cmm_texts.h"
#include "paper/cmm/paper_table5.h"
#include "render/plot.h"

namespace octoblisk::demos {
namespace {

constexpr double kMagnification = 100.0;  // of deviations in the profile plots

/// Rotates a section so that its chord lies along x, with the leading edge at 0.
class ChordFrame {
 public:
  ChordFrame(const BladeStrip& strip, std::size_t row)
      : origin_(strip.grid.at(row, 0).flat),
        along_((strip.grid.at(row, strip.trailing_edge).flat - origin_).normalized()) {}

  Vec2 operator()(const Vec2& flat) const { return turned(flat - origin_); }
  Vec2 turned(const Vec2& vector) const {
    return {along_.dot(vector), along_.x() * vector.y() - along_.y() * vector.x()};
  }

 private:
  Vec2 origin_, along_;
};

std::size_t middleRow(const BladeStrip& strip) { return strip.measured_rows[strip.measured_rows.size() / 2]; }

/// The section moved outwards by a constant deviation, magnified.
Series curveAt(const BladeStrip& strip, std::size_t row, double deviation, std::string name,
               SeriesStyle style) {
  const ChordFrame frame(strip, row);
  Series series{.name = std::move(name), .x = {}, .y = {}, .style = style};
  for (std::size_t k = 0; k <= strip.grid.stations(); ++k) {
    const SectionGrid::Point& point = strip.grid.at(row, k % strip.grid.stations());
    const Vec2 place = frame(point.flat + kMagnification * deviation * point.flat_normal);
    series.x.push_back(place.x());
    series.y.push_back(place.y());
  }
  return series;
}

Plot profilePlot(const CmmExperiment& experiment, double MeasuredPoint::*deviation, const std::string& when) {
  const BladeStrip& strip = experiment.strip;
  const std::size_t row = middleRow(strip);
  const ChordFrame frame(strip, row);
  Series measured{.name = "measured", .x = {}, .y = {}, .style = SeriesStyle::line_and_points};
  for (const MeasuredPoint& point : experiment.points) {
    if (point.row != row) continue;
    const SectionGrid::Point& nominal = strip.grid.at(row, point.station);
    const Vec2 place = frame(nominal.flat + kMagnification * (point.*deviation) * nominal.flat_normal);
    measured.x.push_back(place.x());
    measured.y.push_back(place.y());
  }
  measured.x.push_back(measured.x.front());
  measured.y.push_back(measured.y.front());
  return {.title = when + ", deviations magnified " + fixedText(kMagnification, 0) + " times",
          .x_label = "along the chord, mm",
          .y_label = "across the chord, magnified, mm",
          .series = {curveAt(strip, row, 0.0, "nominal", SeriesStyle::line), std::move(measured),
                     curveAt(strip, row, kProfileTolerance, "tolerance +0.05 mm", SeriesStyle::dashed_line)}};
}

/// The errors of an area of the middle section over the length along the section; those of the leading edge
/// start on its concave side.
Plot errorPlot(const CmmExperiment& experiment, BladeArea area) {
  const BladeStrip& strip = experiment.strip;
  const std::size_t row = middleRow(strip);
  struct Place {
    double arc;
    const MeasuredPoint* point;
  };
  std::vector<Place> places;
  for (const MeasuredPoint& point : experiment.points) {
    if (point.row != row || point.area != area) continue;
    double arc = strip.grid.at(row, point.station).arc;
    if (area == BladeArea::leading_edge && arc > 0.5 * strip.grid.length(row)) arc -= strip.grid.length(row);
    places.push_back({arc, &point});
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.arc < b.arc; });
  Plot plot{.title = areaName(area),
            .x_label = "along the section from the leading edge, mm",
            .y_label = "error, mm",
            .series = {}};
  Series before{.name = "before", .x = {}, .y = {}};
  Series after{.name = "after", .x = {}, .y = {}};
  for (const Place& place : places) {
    before.x.push_back(place.arc);
    after.x.push_back(place.arc);
    before.y.push_back(place.point->before);
    after.y.push_back(place.point->after);
  }
  const auto index =
      static_cast<std::size_t>(std::find(kBladeAreas.begin(), kBladeAreas.end(), area) - kBladeAreas.begin());
  const auto level = [&](const std::string& name, double value) {
    return Series{.name = name,
                  .x = {before.x.front(), before.x.back()},
                  .y = {value, value},
                  .style = SeriesStyle::dashed_line};
  };
  const Series papers_before = level("paper's mean before", kPaperBefore[index].mean);
  const Series papers_after = level("paper's mean after", kPaperAfter[index].mean);
  plot.series = {std::move(before), std::move(after), papers_before, papers_after};
  return plot;
}

}  // namespace

std::vector<Figure> drawCmmFigures(const CmmExperiment& experiment, const std::filesystem::path& folder) {
  std::vector<Figure> figures;
  const auto add = [&](const std::string& file, const Plot& plot, const std::string& caption) {
    writeSvg(plot, folder / file);
    figures.push_back({file, caption});
  };
  add("fig13a_profile_before.svg", profilePlot(experiment, &MeasuredPoint::before, "Before"),
      "Fig. 13a: the middle section before grinding, simulated. At this magnification the tolerance of -0.05 "
      "mm would lie beyond the blade's other side");
  add("fig13b_profile_after.svg", profilePlot(experiment, &MeasuredPoint::after, "After"),
      "Fig. 13b: the same section after grinding");
  for (const BladeArea area : kBladeAreas) {
    const std::string letter = letterOf(area);
    const char small = static_cast<char>(letter.front() - 'A' + 'a');
    add("fig14" + std::string(1, small) + "_errors.svg", errorPlot(experiment, area),
        "Fig. 14" + std::string(1, small) + ": errors of area " + areaName(area) +
            " of the middle section, simulated");
  }
  return figures;
}

}  // namespace octoblisk::demos
