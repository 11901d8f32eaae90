// The report's section on the ground blade: its tables match the experiment, and its figures exist.
#include "paper/cmm/cmm_section.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/number_text.h"
#include "models/blisk.h"
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
  const Section section = cmmSection(blisk.mesh, blades, runCmm(blisk.mesh, blades, options), folder.path());

  const Table& errors = section.tables.at(0);
  ASSERT_EQ(errors.rows.size(), 8u);
  for (std::size_t area = 0; area < 4; ++area) {
    const auto expectRow = [&](const std::vector<std::string>& row, const ErrorStatistics& ours,
                               const ErrorStatistics& papers) {
      ASSERT_EQ(row.size(), errors.columns.size());
      EXPECT_EQ(row[2], fixedText(ours.min, 4));
      EXPECT_EQ(row[3], fixedText(ours.max, 4));
      EXPECT_EQ(row[4], fixedText(ours.mean, 4));
      EXPECT_EQ(row[5], fixedText(ours.deviation, 4));
      EXPECT_EQ(row[8], fixedText(papers.mean, 4));
    };
    expectRow(errors.rows[area], experiment.before[area], kPaperBefore[area]);
    expectRow(errors.rows[4 + area], experiment.after[area], kPaperAfter[area]);
  }
  for (const Table& table : section.tables) {
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.name;
  }
  EXPECT_EQ(section.figures.size(), 6u);
  for (const Figure& figure : section.figures) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / figure.file)) << figure.file;
  }
}

}  // namespace
}  // namespace octoblisk::demos
