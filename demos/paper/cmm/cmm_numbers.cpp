#include "paper/cmm/cmm_numbers.h"

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace octoblisk::demos {
namespace {

constexpr double kMagnification = 100.0;    // of deviations in the profile plots
constexpr double kProfileTolerance = 0.05;  // mm to either side; assumed

std::size_t middleRow(const BladeStrip& strip) { return strip.measured_rows[strip.measured_rows.size() / 2]; }

struct Deviation {
  std::size_t station;
  double value;
};

/// The middle section with stations moved outwards by their deviations, magnified. Its chord lies along x,
/// with the leading edge at 0.
nlohmann::json curveOf(const BladeStrip& strip, const std::vector<Deviation>& deviations) {
  const std::size_t row = middleRow(strip);
  const Vec2 origin = strip.grid.at(row, 0).flat;
  const Vec2 along = (strip.grid.at(row, strip.trailing_edge).flat - origin).normalized();
  nlohmann::json curve;
  for (const auto& [station, value] : deviations) {
    const SectionGrid::Point& point = strip.grid.at(row, station);
    const Vec2 place = point.flat + kMagnification * value * point.flat_normal - origin;
    curve["x"].push_back(along.dot(place));
    curve["y"].push_back(along.x() * place.y() - along.y() * place.x());
  }
  for (nlohmann::json& coordinates : curve) coordinates.push_back(coordinates.front());  // closes it
  return curve;
}

nlohmann::json profileOf(const CmmExperiment& experiment) {
  const BladeStrip& strip = experiment.strip;
  std::vector<Deviation> nominal, outer, before, after;
  for (std::size_t k = 0; k < strip.grid.stations(); ++k) {
    nominal.push_back({k, 0.0});
    outer.push_back({k, kProfileTolerance});
  }
  for (const MeasuredPoint& point : experiment.points) {
    if (point.row != middleRow(strip)) continue;
    before.push_back({point.station, point.before});
    after.push_back({point.station, point.after});
  }
  return {{"magnification", kMagnification},    {"tolerance", kProfileTolerance},
          {"nominal", curveOf(strip, nominal)}, {"outer", curveOf(strip, outer)},
          {"before", curveOf(strip, before)},   {"after", curveOf(strip, after)}};
}

/// The errors of an area of the middle section over the length along the section; those of the leading edge
/// start on its concave side.
nlohmann::json errorsOfSection(const CmmExperiment& experiment, BladeArea area) {
  const BladeStrip& strip = experiment.strip;
  const std::size_t row = middleRow(strip);
  std::map<double, const MeasuredPoint*> points;
  for (const MeasuredPoint& point : experiment.points) {
    if (point.row != row || point.area != area) continue;
    double arc = strip.grid.at(row, point.station).arc;
    if (area == BladeArea::leading_edge && arc > 0.5 * strip.grid.length(row)) arc -= strip.grid.length(row);
    points[arc] = &point;
  }
  nlohmann::json errors;
  for (const auto& [arc, point] : points) {
    errors["arc"].push_back(arc);
    errors["before"].push_back(point->before);
    errors["after"].push_back(point->after);
  }
  return errors;
}

/// One parameter changed from the value that the tables use.
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
      {"force noise 15 % instead of 5 %", [](CmmExperimentOptions& o) { o.errors.force_noise = 0.15; }},
      {"strokes at twice the distance", [](CmmExperimentOptions& o) { o.process.step_over *= 2.0; }},
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

nlohmann::json optionsOf(const CmmExperimentOptions& options) {
  const GrindingProcess& process = options.process;
  const ContactWheel& wheel = process.wheel;
  return {{"stock",
           {{"correlation_along", options.stock.correlation_along},
            {"correlation_up", options.stock.correlation_up}}},
          {"process",
           {{"set_force", process.set_force},
            {"belt_speed", process.belt_speed},
            {"preston", process.preston},
            {"step_over", process.step_over},
            {"least_feed", process.least_feed},
            {"greatest_feed", process.greatest_feed},
            {"wheel",
             {{"radius", wheel.radius},
              {"width", wheel.width},
              {"shore_a", wheel.shore_a},
              {"cover_modulus", rubberModulus(wheel.shore_a)},
              {"poissons_ratio", wheel.poissons_ratio},
              {"blade_modulus", wheel.blade_modulus},
              {"blade_poissons_ratio", wheel.blade_poissons_ratio}}}}},
          {"errors",
           {{"preston_factor", options.errors.preston_factor},
            {"force_factor", options.errors.force_factor},
            {"force_noise", options.errors.force_noise},
            {"force_correlation", options.errors.force_correlation}}},
          {"cmm", {{"probe_radius", options.cmm.probe_radius}, {"noise", options.cmm.noise}}},
          {"strip", {{"edge_part", options.strip.edge_part}}}};
}

nlohmann::json numbersOf(const AreaStatistics& statistics) {
  nlohmann::json json;
  for (const ErrorStatistics& area : statistics) {
    json.push_back(
        {{"min", area.min}, {"max", area.max}, {"mean", area.mean}, {"deviation", area.deviation}});
  }
  return json;
}

nlohmann::json numbersOf(const PassSummary& pass) {
  return {{"indentation", pass.indentation},
          {"contact_half_width", pass.contact_half_width},
          {"peak_pressure", pass.peak_pressure},
          {"least_force", pass.least_force},
          {"greatest_force", pass.greatest_force},
          {"least_feed", pass.least_feed},
          {"greatest_feed", pass.greatest_feed},
          {"strokes", pass.strokes},
          {"time", pass.time}};
}

}  // namespace

nlohmann::json cmmNumbers(const TriangleMesh& blisk, const BladesFound& blades,
                          const CmmExperimentOptions& options) {
  const CmmExperiment planned = runCmmExperiment(blisk, blades, options);
  CmmExperimentOptions without_plan = options;
  without_plan.plan = PassPlan::even;
  const CmmExperiment even = runCmmExperiment(blisk, blades, without_plan);
  nlohmann::json json = {{"options", optionsOf(options)},
                         {"planned",
                          {{"before", numbersOf(planned.before)},
                           {"after", numbersOf(planned.after)},
                           {"pass", numbersOf(planned.pass)},
                           {"sections", planned.strip.measured_rows.size()}}},
                         {"even", {{"before", numbersOf(even.before)}, {"after", numbersOf(even.after)}}},
                         {"papers_before", numbersOf(kPaperBefore)},
                         {"profile", profileOf(planned)}};
  for (const MeasuredPoint& point : planned.points) json["planned"]["errors_after"].push_back(point.after);
  for (const BladeArea area : kBladeAreas) {
    json["errors_of_section"].push_back(errorsOfSection(planned, area));
  }
  for (const Variation& variation : variations()) {
    CmmExperimentOptions changed = options;
    variation.change(changed);
    json["variations"].push_back(
        {{"name", variation.name}, {"after", numbersOf(runCmmExperiment(blisk, blades, changed).after)}});
  }
  return json;
}

}  // namespace octoblisk::demos
