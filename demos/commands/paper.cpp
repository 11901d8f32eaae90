// octoblisk paper: runs the paper's experiments again and sets its numbers beside ours.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "command_line/option_checks.h"
#include "command_line/subcommand_help.h"
#include "command_line/units_option.h"
#include "commands/commands.h"
#include "commands/paper_run.h"

namespace octoblisk::demos {
namespace {

constexpr int kLeastPoints = 100, kMostPoints = 10'000;

struct PaperSubcommand {
  const char* name;
  unsigned parts;
  const char* help;
};

constexpr PaperSubcommand kPaperSubcommands[] = {
    {"table1", kTable1,
     "Nodes of traditional and improved octrees over one blade, with volumes and false alarms"},
    {"table2", kTable2, "Times to split"},
    {"table3", kTable3,
     "Detection over the grinding path of the blisk: range, time, false alarms and misses"},
    {"table4", kTable4, "The same in the loop of a simulated robot, with its errors and times"},
    {"table5", kTable5,
     "A blade measured before and after a simulated grinding pass, with figures 13 and 14"},
    {"figures", kFigures, "Figures 2, 4, 5, 7, 8, 9 and 10"},
    {"all", kAllParts, "All of these in one report"}};

void addOptions(CLI::App& command, PaperRequest& request) {
  command
      .add_option("--blade", request.blade,
                  "Mesh file: a blisk round the axis Z, of which blade 1 is taken, or a blade alone; "
                  "default: the built-in blisk")
      ->check(notEmpty());
  addUnitsOption(command, request.units);
  command.add_option("--points", request.points, "Points of a blade; the paper does not say how many it has")
      ->check(wholeNumberFrom(kLeastPoints, kMostPoints))
      ->capture_default_str();
  command.add_option("--seed", request.seed, "Of clouds, clusters, poses, stock and noise")
      ->check(wholeNumberFrom(0, std::int64_t{1} << 62))
      ->capture_default_str();
  command
      .add_option("--starts", request.starts,
                  "Runs of k-means from other initial centres, the best of which (eq. 5) counts; 1 is the "
                  "paper's own start")
      ->check(wholeNumberFrom(1, 1000))
      ->capture_default_str();
  command.add_option("-o,--out", request.out, "Folder for report, tables and figures; made where missing")
      ->required()
      ->check(notEmpty());
  command.footer(helpOf("paper").footer);
}

}  // namespace

void addPaperCommand(CLI::App& app, int& exit_code) {
  CLI::App& paper = addSubcommand(app, "paper");
  paper.require_subcommand(1);
  for (const PaperSubcommand& subcommand : kPaperSubcommands) {
    CLI::App& command = *paper.add_subcommand(subcommand.name, subcommand.help);
    const auto request = std::make_shared<PaperRequest>();
    addOptions(command, *request);
    command.callback([request, parts = subcommand.parts, &exit_code] {
      runPaper(*request, parts, std::cerr);
      const std::filesystem::path out = request->out;
      std::cout << "Report: " << (out / "report.html").string() << ", " << (out / "report.md").string()
                << '\n';
      exit_code = 0;
    });
  }
}

}  // namespace octoblisk::demos
