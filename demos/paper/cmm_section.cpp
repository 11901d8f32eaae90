#include "paper/cmm_section.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "cmm/hertz.h"
#include "paper/number_text.h"
#include "report/plot.h"

namespace octoblisk::demos {
namespace {

constexpr double kTolerance = 0.05;       // mm to either side: the profile tolerance of blades
constexpr double kMagnification = 100.0;  // of deviations in the profile plots

std::string mm(double value) { return fixedText(value, 4); }

std::string areaName(BladeArea area) {
  switch (area) {
    case BladeArea::kLeadingEdge:
      return "A leading edge";
    case BladeArea::kConvex:
      return "B convex";
    case BladeArea::kTrailingEdge:
      return "C trailing edge";
    case BladeArea::kConcave:
      return "D concave";
  }
  return {};
}

void addCells(std::vector<std::string>& row, const ErrorStatistics& statistics) {
  for (const double value : {statistics.min, statistics.max, statistics.mean, statistics.deviation}) {
    row.push_back(mm(value));
  }
}

Table tableOf(std::string name, std::string caption, const CmmExperiment& experiment) {
  Table table{.name = std::move(name),
              .caption = std::move(caption),
              .columns = {"", "area", "min", "max", "mean", "std", "paper: min", "paper: max", "paper: mean",
                          "paper: std"},
              .rows = {}};
  const auto add = [&](const std::string& when, const AreaStatistics& ours, const AreaStatistics& papers) {
    for (std::size_t area = 0; area < kBladeAreas.size(); ++area) {
      table.rows.push_back({when, areaName(kBladeAreas[area])});
      addCells(table.rows.back(), ours[area]);
      addCells(table.rows.back(), papers[area]);
    }
  };
  add("before", experiment.before, kPaperBefore);
  add("after", experiment.after, kPaperAfter);
  return table;
}

double meanOverAreas(const AreaStatistics& statistics, double ErrorStatistics::*number) {
  double sum = 0.0;
  for (const ErrorStatistics& area : statistics) sum += area.*number / kBladeAreas.size();
  return sum;
}

/// One parameter at a time away from what the tables use.
struct Variation {
  std::string name;
  std::function<void(CmmExperimentOptions&)> change;
};

std::vector<Variation> variations() {
  return {
      {"no model error, no force error",
       [](CmmExperimentOptions& o) {
         o.errors.preston_factor = o.errors.force_factor = 1.0;
         o.errors.force_noise = 0.0;
       }},
      {"the belt cuts 30 % less than planned",
       [](CmmExperimentOptions& o) { o.errors.preston_factor = 0.7; }},
      {"the belt cuts 10 % more than planned",
       [](CmmExperimentOptions& o) { o.errors.preston_factor = 1.1; }},
      {"force noise 15 % in place of 5 %", [](CmmExperimentOptions& o) { o.errors.force_noise = 0.15; }},
      {"strokes twice as far apart", [](CmmExperimentOptions& o) { o.process.step_over *= 2.0; }},
      {"a wheel half as wide", [](CmmExperimentOptions& o) { o.process.wheel.width *= 0.5; }},
      {"a harder cover, Shore A 60", [](CmmExperimentOptions& o) { o.process.wheel.shore_a = 60.0; }},
      {"another stock and other noise",
       [](CmmExperimentOptions& o) {
         o.stock.seed += 100;
         o.errors.seed += 100;
         o.cmm.seed += 100;
       }},
  };
}

Table variationsTable(const TriangleMesh& blisk, const BladesFound& blades,
                      const CmmExperimentOptions& options, const CmmExperiment& planned,
                      const CmmExperiment& even) {
  Table table{
      .name = "table5_variations",
      .caption = "Mean and standard deviation of the errors after (mm), one parameter changed at a time",
      .columns = {"", "A mean", "B mean", "C mean", "D mean", "A std", "B std", "C std", "D std"},
      .rows = {}};
  const auto add = [&](const std::string& name, const AreaStatistics& after) {
    table.rows.push_back({name});
    for (const ErrorStatistics& area : after) table.rows.back().push_back(mm(area.mean));
    for (const ErrorStatistics& area : after) table.rows.back().push_back(mm(area.deviation));
  };
  add("as in Table 5", planned.after);
  for (const Variation& variation : variations()) {
    CmmExperimentOptions changed = options;
    variation.change(changed);
    add(variation.name, runCmmExperiment(blisk, blades, changed).after);
  }
  add("not planned: one feed everywhere", even.after);
  add("the paper, after", kPaperAfter);
  add("the paper, before", kPaperBefore);
  return table;
}

Table parametersTable(const CmmExperimentOptions& options, const CmmExperiment& experiment) {
  Table table{.name = "table5_parameters",
              .caption = "Parameters of the simulation",
              .columns = {"parameter", "value", "unit", "source"},
              .rows = {}};
  const auto add = [&](const std::string& name, const std::string& value, const std::string& unit,
                       const std::string& source) {
    table.rows.push_back({name, value, unit, source});
  };
  const GrindingProcess& process = options.process;
  const ContactWheel& wheel = process.wheel;
  const PassSummary& pass = experiment.pass;
  const std::string assumed = "assumed";
  add("errors before, by area", "Table 5", "mm", "the paper");
  add("their correlation length along the section, up the blade",
      fixedText(options.stock.correlation_along, 1) + ", " + fixedText(options.stock.correlation_up, 1), "mm",
      assumed);
  add("normal force on a flat", fixedText(process.set_force, 1), "N", "doi 10.1177/1687814017700827");
  add("mean force reached over force set", fixedText(options.errors.force_factor, 3), "",
      "doi 10.1177/1687814017700827 (20.4 N for 20 N)");
  add("force noise, its correlation along a stroke",
      fixedText(100.0 * options.errors.force_noise, 0) + " %, " +
          fixedText(options.errors.force_correlation, 1) + " mm",
      "", assumed);
  add("contact wheel: radius with the belt, width",
      fixedText(wheel.radius, 1) + ", " + fixedText(wheel.width, 1), "mm", assumed);
  add("cover: hardness", fixedText(wheel.shore_a, 0), "Shore A", assumed);
  add("cover: Young's modulus", fixedText(rubberModulus(wheel.shore_a), 2), "MPa",
      "from the hardness by A. N. Gent, 1958");
  add("cover: Poisson's ratio", fixedText(wheel.poissons_ratio, 2), "", "rubber");
  add("blade: Young's modulus, Poisson's ratio",
      fixedText(wheel.blade_modulus / 1000.0, 0) + " GPa, " + fixedText(wheel.blade_poissons_ratio, 2), "",
      "Ti-6Al-4V; the paper names no alloy");
  add("contact on a flat: indentation, half width, peak pressure",
      fixedText(pass.indentation, 2) + " mm, " + fixedText(pass.contact_half_width, 2) + " mm, " +
          fixedText(pass.peak_pressure, 3) + " MPa",
      "", "Hertz: K. L. Johnson, Contact Mechanics, 1985");
  add("force on the blade, from and to",
      fixedText(pass.least_force, 1) + ", " + fixedText(pass.greatest_force, 1), "N",
      "the same peak pressure everywhere");
  add("belt speed v", fixedText(process.belt_speed / 1000.0, 0), "m/s", assumed);
  add("Preston coefficient K_p of dh = K_p p v dt, as planned", fixedText(1e6 * process.preston, 1),
      "10⁻⁶ mm²/N", assumed + "; F. W. Preston, 1927");
  add("true K_p over the planned one", fixedText(options.errors.preston_factor, 2), "",
      assumed + ": a belt somewhat worn");
  add("strokes apart", fixedText(process.step_over, 1), "mm", assumed);
  add("feed, limits", fixedText(process.least_feed, 0) + " to " + fixedText(process.greatest_feed, 0), "mm/s",
      assumed);
  add("feed, as planned", fixedText(pass.least_feed, 1) + " to " + fixedText(pass.greatest_feed, 1), "mm/s",
      "result");
  add("strokes, time of the pass", std::to_string(pass.strokes) + ", " + fixedText(pass.time, 0) + " s", "",
      "result");
  add("CMM: ball radius, noise",
      fixedText(options.cmm.probe_radius, 2) + ", " + fixedText(options.cmm.noise, 4), "mm", assumed);
  add("CMM: sections, points",
      std::to_string(experiment.strip.measured_rows.size()) + ", " + std::to_string(experiment.points.size()),
      "", assumed);
  add("areas A and C: of a side's length at each edge", fixedText(100.0 * options.strip.edge_part, 0) + " %",
      "", assumed);
  return table;
}

/// Turns a section so that its chord lies along x, from the leading edge at 0.
class ChordFrame {
 public:
  ChordFrame(const BladeStrip& strip, std::size_t row)
      : origin_(strip.grid.at(row, 0).flat),
        along_((strip.grid.at(row, strip.trailing_edge).flat - origin_).normalized()) {}

  Vec2 operator()(const Vec2& flat) const { return turned(flat - origin_); }
  Vec2 turned(const Vec2& way) const {
    return {along_.dot(way), along_.x() * way.y() - along_.y() * way.x()};
  }

 private:
  Vec2 origin_, along_;
};

std::size_t middleRow(const BladeStrip& strip) { return strip.measured_rows[strip.measured_rows.size() / 2]; }

/// The section moved outwards everywhere by an even deviation, magnified.
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
  Series measured{.name = "measured", .x = {}, .y = {}, .style = SeriesStyle::kLineAndPoints};
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
          .y_label = "across it, stretched, mm",
          .series = {curveAt(strip, row, 0.0, "nominal", SeriesStyle::kLine), std::move(measured),
                     curveAt(strip, row, kTolerance, "tolerance +0.05 mm", SeriesStyle::kDashedLine)}};
}

/// The errors of an area of the middle section over the way along the section; the leading edge's from its
/// concave side on.
Plot errorPlot(const CmmExperiment& experiment, BladeArea area) {
  const BladeStrip& strip = experiment.strip;
  const std::size_t row = middleRow(strip);
  struct Place {
    double way;
    const MeasuredPoint* point;
  };
  std::vector<Place> places;
  for (const MeasuredPoint& point : experiment.points) {
    if (point.row != row || point.area != area) continue;
    double way = strip.grid.at(row, point.station).arc;
    if (area == BladeArea::kLeadingEdge && way > 0.5 * strip.grid.length(row)) way -= strip.grid.length(row);
    places.push_back({way, &point});
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.way < b.way; });
  Plot plot{.title = areaName(area),
            .x_label = "along the section from the leading edge, mm",
            .y_label = "error, mm",
            .series = {}};
  Series before{.name = "before", .x = {}, .y = {}};
  Series after{.name = "after", .x = {}, .y = {}};
  for (const Place& place : places) {
    before.x.push_back(place.way);
    after.x.push_back(place.way);
    before.y.push_back(place.point->before);
    after.y.push_back(place.point->after);
  }
  const auto index =
      static_cast<std::size_t>(std::find(kBladeAreas.begin(), kBladeAreas.end(), area) - kBladeAreas.begin());
  const auto level = [&](const std::string& name, double value) {
    return Series{.name = name,
                  .x = {before.x.front(), before.x.back()},
                  .y = {value, value},
                  .style = SeriesStyle::kDashedLine};
  };
  const Series papers_before = level("paper's mean before", kPaperBefore[index].mean);
  const Series papers_after = level("paper's mean after", kPaperAfter[index].mean);
  plot.series = {std::move(before), std::move(after), papers_before, papers_after};
  return plot;
}

/// "76-93 %": from the least to the greatest over the areas, of the mean error before.
std::string removedShare(const AreaStatistics& before, const AreaStatistics& after) {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (std::size_t area = 0; area < kBladeAreas.size(); ++area) {
    const double share = 100.0 * (1.0 - after[area].mean / before[area].mean);
    least = std::min(least, share);
    greatest = std::max(greatest, share);
  }
  return fixedText(least, 0) + " to " + fixedText(greatest, 0) + " %";
}

std::string spreadText(const AreaStatistics& before, const AreaStatistics& after) {
  return fixedText(1000.0 * meanOverAreas(before, &ErrorStatistics::deviation), 2) + " to " +
         fixedText(1000.0 * meanOverAreas(after, &ErrorStatistics::deviation), 2) + " µm";
}

/// Mean of the two edges' mean errors less that of the two sides', µm.
double edgesAboveSides(const AreaStatistics& statistics) {
  const auto [leading, convex, trailing, concave] = statistics;
  return 500.0 * (leading.mean + trailing.mean - convex.mean - concave.mean);
}

/// Mean of the two sides' standard deviations, in µm.
std::string sidesText(const AreaStatistics& statistics) {
  const auto [leading, convex, trailing, concave] = statistics;
  return fixedText(500.0 * (convex.deviation + concave.deviation), 2);
}

std::string whatAgrees(const CmmExperiment& planned) {
  std::size_t falling = 0;
  for (std::size_t area = 0; area < kBladeAreas.size(); ++area) {
    falling += std::abs(planned.after[area].mean) < std::abs(planned.before[area].mean) ? 1 : 0;
  }
  const auto outside = std::count_if(planned.points.begin(), planned.points.end(),
                                     [](const auto& point) { return std::abs(point.after) > kTolerance; });
  return "The mean error falls in " + std::to_string(falling) + " of 4 areas, in the paper in all; " +
         (outside == 0 ? std::string("no point ends") : countedText(outside, "point ends", "points end")) +
         " outside the tolerance of ±0.05 mm. ";
}

std::vector<std::string> verdict(const CmmExperiment& planned, const CmmExperiment& even,
                                 const CmmExperimentOptions& options) {
  const double lowest =
      std::min_element(planned.points.begin(), planned.points.end(), [](const auto& a, const auto& b) {
        return a.after < b.after;
      })->after;
  return {
      "What is put in: the errors before. At the measured points the stock has exactly the minimum, maximum, "
      "mean and standard deviation of the paper's Table 5 in each area: a smooth random field is bent by an "
      "increasing function until it does. The CMM then adds its noise, " +
          fixedText(1000.0 * options.cmm.noise, 1) + " µm, to each point.",
      "What comes out: the errors after. The dwell at each pose is planned from the errors measured before, "
      "to take off all of them; the belt then cuts as Hertz's pressure and Preston's removal say, with " +
          fixedText(options.errors.preston_factor, 2) +
          " times the coefficient planned with, and a force that is biased and noisy. No number of the "
          "paper's rows \"after\" enters.",
      whatAgrees(planned) + "What does not agree is by how much it falls. The paper's pass took off " +
          removedShare(kPaperBefore, kPaperAfter) + " of the mean error of an area, ours takes off " +
          removedShare(planned.before, planned.after) +
          ". A pass that is to take off the whole error misses by the share by which the belt cuts otherwise "
          "than planned: for the paper's numbers it would have cut a quarter to a third of what was planned. "
          "Either that pass was not to reach the nominal surface, or it was not planned from these errors; "
          "the paper does not say.",
      "The standard deviation tells more. In the paper it goes from " +
          spreadText(kPaperBefore, kPaperAfter) +
          " (mean of the areas): the grinding did not even the errors out. Here it goes from " +
          spreadText(planned.before, planned.after) + " by the planned pass, and from " +
          spreadText(even.before, even.after) +
          " by one of an even feed that is not planned point by point and is to take off the mean error "
          "(second table); on the sides B and D alone by an even feed from " +
          sidesText(even.before) + " to " + sidesText(even.after) + " µm, in the paper from " +
          sidesText(kPaperBefore) + " to " + sidesText(kPaperAfter) +
          " µm. By an even feed the edges A and C end " + fixedText(edgesAboveSides(even.after), 1) +
          " µm above the sides B and D, by the planned pass " + fixedText(edgesAboveSides(planned.after), 1) +
          " µm, in the paper " + fixedText(edgesAboveSides(kPaperAfter), 1) + " µm.",
      "The lowest point after lies at " + mm(lowest) +
          " mm; below 0 is cut into the nominal blade. A careful pass would be planned with a margin.",
      "Left out: the belt's wear along the pass, its own stiffness and tension, heat, the bending of the "
      "blade under the force (which for a thin blade may exceed the errors), and how errors change the "
      "pressure."};
}

}  // namespace

Section cmmSection(const TriangleMesh& blisk, const BladesFound& blades, const std::filesystem::path& folder,
                   const CmmExperimentOptions& options) {
  const CmmExperiment planned = runCmmExperiment(blisk, blades, options);
  CmmExperimentOptions without_plan = options;
  without_plan.plan = PassPlan::kEven;
  const CmmExperiment even = runCmmExperiment(blisk, blades, without_plan);

  Section section{.title = "Table 5, figures 13 and 14: the blade measured before and after grinding",
                  .paragraphs = verdict(planned, even, options),
                  .tables = {},
                  .figures = {}};
  const std::string points = std::to_string(planned.points.size()) + " points of " +
                             std::to_string(planned.strip.measured_rows.size()) + " sections";
  section.tables.push_back(
      tableOf("table5_errors",
              "Table 5: the error of each area before and after (mm), " + points + ", simulated", planned));
  section.tables.push_back(
      tableOf("table5_even_pass", "The same by a pass that is not planned: one feed everywhere (mm)", even));
  section.tables.push_back(variationsTable(blisk, blades, options, planned, even));
  section.tables.push_back(parametersTable(options, planned));

  const auto add = [&](const std::string& file, const Plot& plot, const std::string& caption) {
    writeSvg(plot, folder / file);
    section.figures.push_back({file, caption});
  };
  add("fig13a_profile_before.svg", profilePlot(planned, &MeasuredPoint::before, "Before"),
      "Fig. 13a: the middle section before grinding, simulated. So magnified, the tolerance of -0.05 mm "
      "would lie beyond the blade's other side");
  add("fig13b_profile_after.svg", profilePlot(planned, &MeasuredPoint::after, "After"),
      "Fig. 13b: and after");
  for (const BladeArea area : kBladeAreas) {
    const std::string letter = letterOf(area);
    const char small = static_cast<char>(letter.front() - 'A' + 'a');
    add("fig14" + std::string(1, small) + "_errors.svg", errorPlot(planned, area),
        "Fig. 14" + std::string(1, small) + ": errors of area " + areaName(area) +
            " of the middle section, simulated");
  }
  return section;
}

}  // namespace octoblisk::demos
