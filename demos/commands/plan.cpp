// octoblisk plan: plans paths that grind the sides and edges of a blade.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numeric>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "command_line/blisk_options.h"
#include "command_line/grinder_input.h"
#include "command_line/help.h"
#include "command_line/options.h"
#include "command_line/terminal_watch.h"
#include "commands/commands.h"
#include "io/new_file.h"
#include "io/number_text.h"
#include "io/whole_files.h"
#include "models/length_limit.h"
#include "plan/side_plan.h"
#include "render/picture.h"
#include "report/coverage_report.h"
#include "toolpath/cl_motions.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

struct PlanRequest {
  GrinderFiles files;
  std::string convex;  // empty: found
  std::string side = "all";
  bool all_blades = false;
  std::vector<std::string> next_tools;  // files
  std::string format = "csv";
  double feed = 1000.0;                               // mm/min
  std::optional<double> depth, scallop, chord_error;  // mm; empty: parts of the depth limit
};

/// The planned side of a blade.
struct PlannedSide {
  SidePlan plan;
  Coverage coverage;
};

PlanOptions optionsOf(const PlanRequest& request, double max_depth) {
  constexpr double kPressed = 0.8, kScallop = 0.5;  // of the limit, of the depth
  PlanOptions options;
  options.depth = request.depth.value_or(kPressed * max_depth);
  options.scallop = request.scallop.value_or(kScallop * options.depth);
  // Between two contacts, a chord may add half of what is left up to the limit.
  options.chord_error = request.chord_error.value_or(0.5 * (max_depth - options.depth));
  options.threads = request.files.threads;
  if (options.depth >= max_depth) {
    throw std::invalid_argument("--depth: must be below the depth limit of the belt, " +
                                shortText(max_depth) + " mm");
  }
  if (options.scallop > options.depth) {
    throw std::invalid_argument("--scallop: must not be above the depth, " + shortText(options.depth) +
                                " mm: the ridges between passes would not be ground");
  }
  return options;
}

/// The blisk with one of the tools.
class BliskPlan {
 public:
  BliskPlan(const PlanRequest& request, GrinderFiles files)
      : convex_(request.convex),
        files_(std::move(files)),
        input_(readGrinder(files_)),
        blisk_(moved(input_.blisk->mesh(), input_.mesh_in_blisk)) {
    const std::string name = files_.bliskName();
    if (input_.blades.count == 0) throw std::invalid_argument(name + ": no blades were found: check --axis");
    anatomy_ = anatomyOf(blisk_, input_.blades, name);
    rules_ = reachRulesOf(files_, input_, 0, 0.0);
    const ClusteredOctree& belt = *input_.tool.parts[rules_.grinding_part].tree;
    wheel_ = wheelOf(belt);
    if (wheel_.radius <= 0.0) {
      throw std::invalid_argument(files_.toolName() +
                                  ": the belt has no contact wheel at the origin, on its -x side");
    }
    options_ = optionsOf(request, rules_.max_depth);
  }

  const GrinderInput& input() const { return input_; }

  PlannedSide plan(int blade, const std::string& side, const GroundBefore& before,
                   TerminalWatch& terminal) const {
    VerdictRules rules = rules_;
    rules.ground_blade = blade;
    Judge judge(input_.blisk, input_.tool.parts, input_.blades.blade_of_triangle, rules, files_.threads,
                input_.fixtures);
    const WheelSeat seat(input_.blisk->mesh(), anatomy_.sides.blade_of_triangle, blade, wheel_.radius,
                         wheel_.width);
    PlannedSide planned{
        .plan = {},
        .coverage = {.blade = blade,
                     .grid = gridOver(BladeContours(blisk_, anatomy_.sides, blade),
                                      regionNamed(side, convex_, anatomy_, files_.bliskName())),
                     .side = side,
                     .mesh_in_blisk = input_.mesh_in_blisk,
                     .max_depth = rules.max_depth,
                     .points = {}}};
    planned.plan = planSide(judge, planned.coverage.grid, input_.mesh_in_blisk, seat, options_, before,
                            terminal.watch());
    planned.coverage.points = planned.plan.points;
    terminal.endTask();
    return planned;
  }

 private:
  std::string convex_;  // empty: found
  GrinderFiles files_;
  GrinderInput input_;
  TriangleMesh blisk_;  // about the Z axis
  BliskAnatomy anatomy_;
  VerdictRules rules_;  // without the ground blade
  WheelSize wheel_;
  PlanOptions options_;
};

/// Links are rapid, except the motion that leads down to a contact.
std::vector<ToolMotion> motionsOf(const SidePlan& plan, double feed) {
  std::vector<ToolMotion> motions;
  for (std::size_t p = 0; p < plan.path.size(); ++p) {
    motions.push_back({plan.path[p], plan.grinds[p] ? feed : 0.0});
  }
  return motions;
}

std::string rowsOf(const std::string& path, const PlannedSide& planned) {
  std::ostringstream rows;
  for (const PlannedSetup& setup : planned.plan.setups) {
    rows << path << ',' << setup.posture.lead << ',' << setup.posture.tilt << ',' << setup.posture.slide
         << ',' << setup.runs << ',' << setup.poses << ',' << 100.0 * setup.ground << '\n';
  }
  return rows.str();
}

void print(const PlannedSide& planned, const GrinderInput& input, const std::string& path) {
  const SidePlan& plan = planned.plan;
  std::cout << path << ": ";
  if (plan.path.empty()) {
    std::cout << "not written: the tool grinds nothing here\n";
  } else {
    std::cout << countedText(plan.path.size(), "pose", "poses") << " in "
              << countedText(plan.setups.size(), "setup", "setups") << '\n';
  }
  std::cout << summaryText(planned.coverage);
  constexpr double kWorthALine = 5e-4;  // 0.1 %, rounded
  for (const UnreachedArea& area : plan.unreached) {
    if (area.share < kWorthALine) continue;
    std::cout << "Out of reach: " << shareText(area.share, 1.0) << ", where the "
              << input.tool.parts[area.obstacle.part].name
              << (area.obstacle.too_deep ? " would be too deep in " : " would touch ")
              << input.names().nameOf(area.obstacle.blade) << '\n';
  }
}

/// The planner of each tool, in order.
std::vector<std::unique_ptr<BliskPlan>> plannersOf(const PlanRequest& request) {
  std::vector<std::unique_ptr<BliskPlan>> planners;
  planners.push_back(std::make_unique<BliskPlan>(request, request.files));
  for (const std::string& tool : request.next_tools) {
    GrinderFiles files = request.files;
    files.tool = tool;
    files.belt.clear();
    planners.push_back(std::make_unique<BliskPlan>(request, std::move(files)));
  }
  return planners;
}

class PlanFiles {
 public:
  explicit PlanFiles(const PlanRequest& request) : request_(request), out_(request.files.out) {}

  /// Writes the files of a side, and the table of all setups so far.
  void write(const std::string& name, const PlannedSide& planned) {
    WholeFiles whole;
    const std::string path = nameOfPath(name);
    setups_ += rowsOf(path, planned);
    const std::vector<ToolMotion> motions = motionsOf(planned.plan, request_.feed);
    if (!motions.empty() && request_.format == "apt") writeClFile(whole.add(out_ / path), motions);
    if (!motions.empty() && request_.format == "csv") writeMotions(whole.add(out_ / path), motions);
    writeCoverage(planned.coverage, whole.add(out_ / (name + "-coverage.csv")));
    writePng(coveragePicture(planned.coverage), whole.add(out_ / (name + "-coverage.png")).string());
    writeFile(whole.add(out_ / "setups.csv"), setups_);
    whole.finish();
  }

  std::string nameOfPath(const std::string& name) const { return name + '.' + request_.format; }

 private:
  const PlanRequest& request_;
  const std::filesystem::path out_;
  std::string setups_ = "path,lead_deg,tilt_deg,slide_mm,runs,poses,ground_percent\n";
};

int plan(const PlanRequest& request) {
  const auto planners = plannersOf(request);
  const GrinderInput& input = planners.front()->input();
  makeFolder(request.files.out);
  warnOfInput(request.files, input);
  TerminalWatch terminal(1000);
  std::vector<int> blades = {request.files.ground_blade.value_or(1)};
  if (request.all_blades) {
    blades.resize(static_cast<std::size_t>(input.blades.count));
    std::iota(blades.begin(), blades.end(), 1);
  }
  std::vector<std::string> sides = {request.side};
  if (request.side == "all") sides = {"convex", "concave", "leading", "trailing"};
  PlanFiles files(request);
  std::size_t empty_paths = 0;
  for (const int blade : blades) {
    for (const std::string& side : sides) {
      GroundBefore before;
      for (std::size_t tool = 0; tool < planners.size(); ++tool) {
        const std::string name = "blade-" + std::to_string(blade) + '-' + side +
                                 (tool == 0 ? std::string() : "-tool-" + std::to_string(tool + 1));
        const PlannedSide planned = planners[tool]->plan(blade, side, before, terminal);
        files.write(name, planned);
        print(planned, planners[tool]->input(),
              (std::filesystem::path(request.files.out) / files.nameOfPath(name)).string());
        if (planned.plan.is_partial) {
          throw TerminalWatch::stopped("stopped: " + request.files.out + " has the setups planned so far");
        }
        before = {planned.plan.points, before.poses + planned.plan.path.size()};
        empty_paths += planned.plan.path.empty();
      }
    }
  }
  return empty_paths == 0 ? 0 : 1;
}

}  // namespace

void addPlanCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = addSubcommand(app, "plan");
  const auto request = std::make_shared<PlanRequest>();
  addGrinderOptions(command, request->files);
  addConvexOption(command, request->convex);
  addChoice(command, "--side", request->side, {"convex", "concave", "leading", "trailing", "all"},
            "Surface to grind: a side, an edge, or all four, each with a path of its own");
  command.add_flag("--all-blades", request->all_blades, "Plan a path for each blade of the blisk")
      ->excludes(command.get_option("--ground-blade"));
  addOption(command, "--next-tool", request->next_tools, "FILE", notEmpty(),
            "JSON file of a tool that grinds what the tools before it leave; may be repeated")
      ->allow_extra_args(false);
  addChoice(command, "--format", request->format, {"csv", "apt"},
            "csv: tables of poses with feeds; apt: CL files");
  addOption(command, "--feed", request->feed, "MM/MIN", numberFrom(0.0, 1e9, true),
            "Feed rate of the passes; links are rapid");
  const auto addLength = [&](const std::string& option, std::optional<double>& value,
                             const std::string& help) {
    addOption(command, option, value, "MM", numberFrom(0.0, kMaxLength, true), help);
  };
  addLength("--depth", request->depth,
            "Depth to which the belt is pressed into the surface. Default: 0.8 of the belt's depth limit");
  addLength("--scallop", request->scallop,
            "Greatest height of the ridges between passes. Default: half of the depth");
  addLength("--chord-error", request->chord_error,
            "Greatest distance between the surface and the chord of two contacts. Default: half of the "
            "difference between the depth limit and the depth");
  command.callback([request, &exit_code] { exit_code = plan(*request); });
}

}  // namespace octoblisk::demos
