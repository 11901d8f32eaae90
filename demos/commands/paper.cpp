// octoblisk paper: reruns the paper's experiments and compares its numbers with ours.
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

constexpr int kMinPoints = 100, kMaxPoints = 10'000;

struct PaperSubcommand {
  const char* name;
  unsigned parts;
  const char* help;
};

constexpr PaperSubcommand kPaperSubcommands[] = {
    {"table1", kTable1,
     "Nodes of the traditional and the improved octree over one blade, with volumes and false alarms"},
    {"table2", kTable2, "Times to build both octrees"},
    {"table3", kTable3,
     "Detection over the grinding path of the blisk: range, time, false alarms and misses"},
    {"table4", kTable4,
     "The same detection in the control loop of a simulated robot, with its errors and times"},
    {"table5", kTable5,
     "A blade measured before and after a simulated grinding pass, with figures 13 and 14"},
    {"figures", kFigures, "Figures 2, 4, 5, 7, 8, 9 and 10"},
    {"all", kAllParts, "All tables and figures in one report"}};

void addOptions(CLI::App& command, PaperRequest& request) {
  command
      .add_option("--blade", request.blade,
                  "Mesh file: a blisk about the Z axis, whose blade 1 is used, or a single blade. Default: "
                  "the built-in blisk")
      ->type_name("FILE")
      ->check(notEmpty());
  addUnitsOption(command, request.units);
  command.add_option("--points", request.points, "Number of points on a blade; the paper does not give it")
      ->type_name("N")
      ->check(wholeNumberFrom(kMinPoints, kMaxPoints))
      ->capture_default_str();
  command.add_option("--seed", request.seed, "Seed of clouds, clusters, poses, stock and noise")
      ->type_name("N")
      ->check(wholeNumberFrom(0, std::int64_t{1} << 62))
      ->capture_default_str();
  command
      .add_option("--starts", request.starts,
                  "Number of k-means runs, each from different initial centres; the best by eq. 5 counts. 1 "
                  "is the paper's method")
      ->type_name("N")
      ->check(wholeNumberFrom(1, 1000))
      ->capture_default_str();
  command
      .add_option("-o,--out", request.out, "Folder for the report, tables and figures; created if missing")
      ->type_name("DIR")
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
