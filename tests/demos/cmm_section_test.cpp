// The report's section on the ground blade: its tables match the experiment, and its figures exist.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "demos/paper_report.h"
#include "io/number_text.h"
#include "models/blisk.h"
#include "paper/cmm/cmm_numbers.h"
#include "scratch_folder.h"

namespace octoblisk::demos {
namespace {

TEST(CmmSectionOfReport, showsTheExperimentBesideThePaper) {
  const Blisk blisk = makeDefaultBlisk(20'000);
  const BladesFound blades = findBlades(blisk.mesh);
  CmmExperimentOptions options;
  options.strip.span_from = 0.6;
  options.strip.span_to = 0.7;  // a narrow strip takes less time
  options.strip.sections = 3;
  const CmmExperiment experiment = runCmmExperiment(blisk.mesh, blades, options);
  const ScratchFolder folder;
  const PaperReport report = reportOf("table5", "table5", cmmNumbers(blisk.mesh, blades, options));
  writePaperReport(report, folder.path());

  const Table& errors = tableOf(report, "table5_errors");
  ASSERT_EQ(errors.rows.size(), 8u);
  const std::array<std::string, 4> papers_after = {"0.0183", "0.0154", "0.0181", "0.0168"};
  for (std::size_t area = 0; area < 4; ++area) {
    const auto expectRow = [&](const std::vector<std::string>& row, const ErrorStatistics& ours,
                               const std::string& papers_mean) {
      ASSERT_EQ(row.size(), errors.columns.size());
      EXPECT_EQ(row[2], fixedText(ours.min, 4));
      EXPECT_EQ(row[3], fixedText(ours.max, 4));
      EXPECT_EQ(row[4], fixedText(ours.mean, 4));
      EXPECT_EQ(row[5], fixedText(ours.deviation, 4));
      EXPECT_EQ(row[8], papers_mean);
    };
    expectRow(errors.rows[area], experiment.before[area], fixedText(kPaperBefore[area].mean, 4));
    expectRow(errors.rows[4 + area], experiment.after[area], papers_after[area]);
  }
  EXPECT_EQ(report.plots.size(), 6u);
  for (const PaperPlot& plot : report.plots) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / plot.file)) << plot.file;
  }
}

}  // namespace
}  // namespace octoblisk::demos
