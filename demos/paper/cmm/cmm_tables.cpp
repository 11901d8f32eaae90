#include "paper/cmm/cmm_tables.h"

#include <functional>
#include <utility>

#include "io/number_text.h"
#include "paper/cmm/cmm_texts.h"
#include "paper/cmm/hertz.h"
#include "paper/cmm/paper_table5.h"

namespace octoblisk::demos {
namespace {

void addCells(std::vector<std::string>& row, const ErrorStatistics& statistics) {
  for (const double value : {statistics.min, statistics.max, statistics.mean, statistics.deviation}) {
    row.push_back(mm(value));
  }
}

Table tableOf(std::string name, std::string caption, const CmmExperiment& experiment) {
  Table table{.name = std::move(name),
              .caption = std::move(caption),
              .columns = {"when", "area", "min", "max", "mean", "std", "paper: min", "paper: max",
                          "paper: mean", "paper: std"},
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

Table variationsTable(const TriangleMesh& blisk, const BladesFound& blades,
                      const CmmExperimentOptions& options, const CmmExperiment& planned,
                      const CmmExperiment& even) {
  Table table{
      .name = "table5_variations",
      .caption =
          "Mean and standard deviation of the errors after grinding (mm), one parameter changed at a time",
      .columns = {"pass", "A mean", "B mean", "C mean", "D mean", "A std", "B std", "C std", "D std"},
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
  add("not planned: one feed for all poses", even.after);
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
  add("correlation length of the errors along the section, up the blade",
      fixedText(options.stock.correlation_along, 1) + ", " + fixedText(options.stock.correlation_up, 1), "mm",
      assumed);
  add("normal force on a flat", fixedText(process.set_force, 1), "N", "doi 10.1177/1687814017700827");
  add("mean force reached divided by force set", fixedText(options.errors.force_factor, 3), "",
      "doi 10.1177/1687814017700827 (20.4 N for 20 N)");
  add("force noise; its correlation length along a stroke",
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
  add("least and greatest force on the blade",
      fixedText(pass.least_force, 1) + ", " + fixedText(pass.greatest_force, 1), "N",
      "the same peak pressure everywhere");
  add("belt speed v", fixedText(process.belt_speed / 1000.0, 0), "m/s", assumed);
  add("Preston coefficient K_p of dh = K_p p v dt, as planned", fixedText(1e6 * process.preston, 1),
      "10⁻⁶ mm²/N", assumed + "; F. W. Preston, 1927");
  add("true K_p divided by the planned K_p", fixedText(options.errors.preston_factor, 2), "",
      assumed + ": a slightly worn belt");
  add("distance between strokes", fixedText(process.step_over, 1), "mm", assumed);
  add("limits of the feed", fixedText(process.least_feed, 0) + " to " + fixedText(process.greatest_feed, 0),
      "mm/s", assumed);
  add("planned feed", fixedText(pass.least_feed, 1) + " to " + fixedText(pass.greatest_feed, 1), "mm/s",
      "result");
  add("number of strokes, time of the pass",
      std::to_string(pass.strokes) + ", " + fixedText(pass.time, 0) + " s", "", "result");
  add("CMM: ball radius, noise",
      fixedText(options.cmm.probe_radius, 2) + ", " + fixedText(options.cmm.noise, 4), "mm", assumed);
  add("CMM: sections, points",
      std::to_string(experiment.strip.measured_rows.size()) + ", " + std::to_string(experiment.points.size()),
      "", assumed);
  add("profile tolerance in figure 13, to either side", fixedText(kProfileTolerance, 2), "mm", assumed);
  add("areas A and C: share of a side's length at each edge",
      fixedText(100.0 * options.strip.edge_part, 0) + " %", "", assumed);
  return table;
}

}  // namespace

std::vector<Table> cmmTables(const TriangleMesh& blisk, const BladesFound& blades,
                             const CmmExperimentOptions& options, const CmmExperiment& planned,
                             const CmmExperiment& even) {
  const std::string points = std::to_string(planned.points.size()) + " points of " +
                             std::to_string(planned.strip.measured_rows.size()) + " sections";
  return {
      tableOf("table5_errors",
              "Table 5: the error of each area before and after (mm), " + points + ", simulated", planned),
      tableOf("table5_even_pass", "The same for a pass that is not planned: one feed for all poses (mm)",
              even),
      variationsTable(blisk, blades, options, planned, even), parametersTable(options, planned)};
}

}  // namespace octoblisk::demos
