// Reports as CSV, Markdown and HTML, and the plots in them.
#include "render/document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "demos/command.h"
#include "demos/scratch_folder.h"
#include "render/flow_chart.h"
#include "render/plot.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const Table kAwkward{.name = "awkward",
                     .caption = "a|b",
                     .columns = {"k", "a,b", "say \"x\""},
                     .rows = {{"1", "two\nlines", "<b>&|"}, {"*2*", "", "3"}}};

TEST(Document, csvQuotesWhatItMust) {
  const ScratchFolder folder;
  writeCsv(kAwkward, folder.path());
  EXPECT_EQ(contentOf(folder.path() / "awkward.csv"),
            "k,\"a,b\",\"say \"\"x\"\"\"\n1,\"two\nlines\",<b>&|\n*2*,,3\n");
}

TEST(Document, markdownLeavesTheTextAsItIs) {
  const std::string text = markdownOf({.title = "T_1",
                                       .paragraphs = {"1. no list", "# no title", "2 < 3"},
                                       .sections = {{"S", {}, {kAwkward}}}});
  EXPECT_EQ(text,
            "# T\\_1\n\n1\\. no list\n\n\\# no title\n\n2 \\< 3\n\n## S\n\n**a\\|b**\n\n"
            "| k | a,b | say \"x\" |\n| --- | --- | --- |\n| 1 | two lines | \\<b>\\&\\| |\n"
            "| \\*2\\* |  | 3 |\n\n");
}

TEST(Document, htmlHoldsItsFiguresAndEscapesItsText) {
  const ScratchFolder folder;
  // RFC 4648's own examples of base64.
  for (const std::string bytes : {"foob", "fooba", "foobar"}) folder.write(bytes + ".png", bytes);
  const Section section{
      "S", {"a < b & c"}, {kAwkward}, {{"foob.png", "\"1\""}, {"fooba.png", ""}, {"foobar.png", ""}}};
  const std::string page = htmlOf({.title = "<T>", .sections = {section}}, folder.path());
  EXPECT_THAT(page, HasSubstr("<title>&lt;T&gt;</title>"));
  EXPECT_THAT(page, HasSubstr("<p>a &lt; b &amp; c</p>"));
  EXPECT_THAT(page, HasSubstr("<td>&lt;b&gt;&amp;|</td>"));
  EXPECT_THAT(page, HasSubstr("alt=\"&quot;1&quot;\" src=\"data:image/png;base64,Zm9vYg==\""));
  EXPECT_THAT(page, HasSubstr("base64,Zm9vYmE=\""));
  EXPECT_THAT(page, HasSubstr("base64,Zm9vYmFy\""));
  EXPECT_THAT(page, Not(HasSubstr("<b>")));
}

TEST(Document, htmlLinksToItsSections) {
  const ScratchFolder folder;
  const std::string page =
      htmlOf({.title = "T", .sections = {{"first & best", {}}, {"second", {}, {kAwkward}}}}, folder.path());
  EXPECT_THAT(page, HasSubstr("<a href=\"#s1\">first &amp; best</a>"));
  EXPECT_THAT(page, HasSubstr("<h2 id=\"s1\">first &amp; best</h2>"));
  EXPECT_THAT(page, HasSubstr("<a href=\"#s2\">second</a>"));
  EXPECT_THAT(page, HasSubstr("<figcaption>a|b</figcaption>"));
}

TEST(Document, refusesARaggedTableAndAFigureThatIsNotThere) {
  const ScratchFolder folder;
  const Table ragged{.name = "ragged", .caption = "", .columns = {"a", "b"}, .rows = {{"1", "2"}, {"1"}}};
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { writeCsv(ragged, folder.path()); }),
            "table ragged: row 1 has 1 cells for 2 columns");
  const Document document{.title = "", .sections = {{"S", {}, {}, {{"none.png", ""}}}}};
  EXPECT_THAT(messageOf<std::runtime_error>([&] { writeReport(document, folder.path()); }),
              HasSubstr("none.png: "));
}

TEST(FlowChart, drawsBoxesAndArrowsWithTheirWords) {
  const FlowChart chart{.boxes = {{0.0, 0, "a < b?", FlowShape::question}, {0.5, 1, "so it is"}},
                        .arrows = {{0, 1, "yes"}}};
  const std::string svg = svgOf(chart);
  EXPECT_THAT(svg, HasSubstr(">a &lt; b?</text>"));
  EXPECT_THAT(svg, HasSubstr(">so it is</text>"));
  EXPECT_THAT(svg, HasSubstr(">yes</text>"));
  // 300 × 74 pixels with 40 between them; the arrow runs from the middle of one lower edge to the middle of
  // the other's upper edge.
  EXPECT_THAT(svg, HasSubstr("width=\"510\" height=\"228\""));
  EXPECT_THAT(svg, HasSubstr("M170 94 V114 H340 V134"));
}

TEST(FlowChart, refusesWhatItCannotDraw) {
  EXPECT_THROW(svgOf({}), std::invalid_argument);
  EXPECT_THROW(svgOf({.boxes = {{-1.0, 0, "left"}}, .arrows = {}}), std::invalid_argument);
  const std::vector<FlowBox> boxes = {{0.0, 0, "upper"}, {0.0, 1, "lower"}};
  EXPECT_THROW(svgOf({.boxes = boxes, .arrows = {{0, 2}}}), std::invalid_argument);
  EXPECT_THROW(svgOf({.boxes = boxes, .arrows = {{1, 0}}}), std::invalid_argument);
}

TEST(Plot, drawsEverySeriesWithItsWords) {
  const ScratchFolder folder;
  const double gap = std::numeric_limits<double>::quiet_NaN();
  const Plot plot{.title = "it's <100 %",
                  .x_label = "FNOP",
                  .y_label = "time (ms)",
                  .y_log = true,
                  .series = {{"k_2 & more", {1, 2, 3, 4, 5}, {1, 10, gap, 10, 1}, SeriesStyle::line},
                             {"points", {1, 2}, {3, 4}, SeriesStyle::points}}};
  const std::filesystem::path file = folder.path() / "it's a plot.svg";
  writeSvg(plot, file);
  const std::string svg = contentOf(file);
  for (const char* words : {"it's &lt;100 %", "FNOP", "time (ms)", "k_2 &amp; more", "points", "</svg>"}) {
    EXPECT_THAT(svg, HasSubstr(words));
  }
  EXPECT_THAT(gnuplotScript(plot), HasSubstr("2 10\n\n4 10\n")) << "the gap";
}

TEST(Plot, refusesWhatItCannotDraw) {
  const ScratchFolder folder;
  const auto message = [&](const Plot& plot, const std::string& file) {
    try {
      writeSvg(plot, folder.path() / file);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Plot plot{.title = "t", .series = {{"short", {1, 2}, {1}}}};
  EXPECT_THAT(message(plot, "p.svg"), HasSubstr("series 'short' has 2 x and 1 y"));
  plot.series = {};
  EXPECT_THAT(message(plot, "p.svg"), HasSubstr("no series"));
  plot.series = {{"s", {1, 2}, {1, 2}}};
  EXPECT_THAT(message(plot, "none/p.svg"), HasSubstr("p.svg: cannot be written"));
  plot.series = {{"s", {1, 2}, {std::nan(""), std::nan("")}}};
  EXPECT_THAT(message(plot, "p.svg"), HasSubstr("gnuplot cannot draw the plot: "));
}

TEST(Plot, namesThePackageWhereGnuplotIsMissing) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nonexistent", 1);
  const std::string message = messageOf<std::runtime_error>([] { requireGnuplot(); });
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(message, HasSubstr("apt install gnuplot-nox"));
  requireGnuplot();
}

}  // namespace
}  // namespace octoblisk::demos
