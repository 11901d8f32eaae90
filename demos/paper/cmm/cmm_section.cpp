#include "paper/cmm/cmm_section.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "io/number_text.h"
#include "paper/cmm/cmm_plots.h"
#include "paper/cmm/cmm_tables.h"
#include "paper/cmm/cmm_texts.h"
#include "paper/cmm/paper_table5.h"

namespace octoblisk::demos {
namespace {

double meanOverAreas(const AreaStatistics& statistics, double ErrorStatistics::*number) {
  double sum = 0.0;
  for (const ErrorStatistics& area : statistics) sum += area.*number / kBladeAreas.size();
  return sum;
}

/// "76-93 %": the least and the greatest share of an area's mean error that was removed.
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

/// The mean of the two edges' mean errors minus that of the two sides', in µm.
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
  const auto outside = std::count_if(planned.points.begin(), planned.points.end(), [](const auto& point) {
    return std::abs(point.after) > kProfileTolerance;
  });
  return "The mean error decreases in " + std::to_string(falling) + " of 4 areas, in the paper in all 4; " +
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
      "Input: the errors before grinding. At the measured points the stock has exactly the minimum, maximum, "
      "mean and standard deviation of the paper's Table 5 in each area: an increasing function maps a smooth "
      "random field to values with these statistics. The CMM then adds its noise, " +
          fixedText(1000.0 * options.cmm.noise, 1) + " µm, to each point.",
      "Output: the errors after grinding. The dwell at each pose is planned from the errors measured before, "
      "to remove all of them. The belt then cuts by Hertz's pressure and Preston's removal, with " +
          fixedText(options.errors.preston_factor, 2) +
          " times the planned coefficient, and with a force that is biased and noisy. The simulation does "
          "not use the paper's rows \"after\".",
      whatAgrees(planned) + "The amounts do not agree. The paper's pass removed " +
          removedShare(kPaperBefore, kPaperAfter) + " of an area's mean error, ours removes " +
          removedShare(planned.before, planned.after) +
          ". A pass that is planned to remove the whole error misses by the share by which the belt cuts "
          "more or less than planned. For the paper's numbers, it would have cut only a quarter to a third "
          "of the planned amount. Either that pass was not meant to reach the nominal surface, or it was not "
          "planned from these errors; the paper does not say.",
      "The standard deviation shows more. In the paper it changes from " +
          spreadText(kPaperBefore, kPaperAfter) +
          " (mean of the areas): the grinding did not even the errors out. Here it changes from " +
          spreadText(planned.before, planned.after) + " with the planned pass, and from " +
          spreadText(even.before, even.after) +
          " with a pass of one even feed, which is not planned point by point and is meant to remove the "
          "mean error (second table). On the sides B and D alone it changes with the even feed from " +
          sidesText(even.before) + " to " + sidesText(even.after) + " µm, and in the paper from " +
          sidesText(kPaperBefore) + " to " + sidesText(kPaperAfter) +
          " µm. With the even feed the edges A and C end " + fixedText(edgesAboveSides(even.after), 1) +
          " µm above the sides B and D, with the planned pass " +
          fixedText(edgesAboveSides(planned.after), 1) + " µm, and in the paper " +
          fixedText(edgesAboveSides(kPaperAfter), 1) + " µm.",
      "The lowest point after grinding is at " + mm(lowest) +
          " mm; a negative value is a cut into the nominal blade. A careful pass would be planned with a "
          "margin.",
      "Not modelled: the belt's wear along the pass, its own stiffness and tension, heat, the bending of the "
      "blade under the force (which for a thin blade may exceed the errors), and the effect of the errors on "
      "the "
      "pressure."};
}

}  // namespace

CmmRuns runCmm(const TriangleMesh& blisk, const BladesFound& blades, const CmmExperimentOptions& options) {
  CmmExperimentOptions without_plan = options;
  without_plan.plan = PassPlan::even;
  return {options, runCmmExperiment(blisk, blades, options), runCmmExperiment(blisk, blades, without_plan)};
}

Section cmmSection(const TriangleMesh& blisk, const BladesFound& blades, const CmmRuns& runs,
                   const std::filesystem::path& folder) {
  return {.title = "Table 5, figures 13 and 14: the blade measured before and after grinding",
          .paragraphs = verdict(runs.planned, runs.even, runs.options),
          .tables = cmmTables(blisk, blades, runs.options, runs.planned, runs.even),
          .figures = drawCmmFigures(runs.planned, folder)};
}

std::vector<Claim> cmmClaims(const CmmRuns& runs) {
  return {{"Table 5: share of an area's mean error that the pass removes, least to greatest (here simulated)",
           removedShare(kPaperBefore, kPaperAfter), removedShare(runs.planned.before, runs.planned.after)}};
}

}  // namespace octoblisk::demos
