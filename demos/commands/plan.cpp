// octoblisk plan: plans a path that grinds the sides of a blade.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
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
  std::string side = "both";
  bool all_blades = false;
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

/// What all sides have in common.
class BliskPlan {
 public:
  BliskPlan(const PlanRequest& request, const GrinderInput& input)
      : request_(request), input_(input), blisk_(moved(input.blisk->mesh(), input.mesh_in_blisk)) {
    const std::string name = request.files.bliskName();
    if (input.blades.count == 0) throw std::invalid_argument(name + ": no blades were found: check --axis");
    sides_ = findBladeSides(blisk_, input.blades);
    convex_ = convexSideOf(request.convex, input);
    if (!convex_) throw std::runtime_error(name + ": the convex side is unknown: give it with --convex");
  }

  PlannedSide plan(int blade, const std::string& side, TerminalWatch& terminal) const {
    const VerdictRules rules = reachRulesOf(request_.files, input_, blade, 0.0);
    const ClusteredOctree& belt = *input_.tool.parts[rules.grinding_part].tree;
    const WheelSize wheel = wheelOf(belt);
    if (wheel.radius <= 0.0) {
      throw std::invalid_argument(request_.files.toolName() +
                                  ": the belt has no contact wheel at the origin, on its -x side");
    }
    Judge judge(input_.blisk, input_.tool.parts, input_.blades.blade_of_triangle, rules,
                request_.files.threads, input_.fixtures);
    const WheelSeat seat(input_.blisk->mesh(), sides_.blade_of_triangle, blade, wheel.radius, wheel.width);
    const bool is_forward = (side == "convex") == (*convex_ == BladeSide::forward);
    PlannedSide planned{.plan = {},
                        .coverage = {.blade = blade,
                                     .grid = gridOver(BladeContours(blisk_, sides_, blade),
                                                      is_forward ? BladeSide::forward : BladeSide::backward),
                                     .side = side,
                                     .mesh_in_blisk = input_.mesh_in_blisk,
                                     .max_depth = rules.max_depth,
                                     .points = {}}};
    planned.plan = planSide(judge, planned.coverage.grid, input_.mesh_in_blisk, seat,
                            optionsOf(request_, rules.max_depth), terminal.watch());
    planned.coverage.points = planned.plan.points;
    terminal.endTask();
    return planned;
  }

 private:
  const PlanRequest& request_;
  const GrinderInput& input_;
  TriangleMesh blisk_;  // about the Z axis
  BladeSides sides_;
  std::optional<BladeSide> convex_;
};

/// The rapid motions of a path are the links, without the last one down to a contact.
std::vector<ToolMotion> motionsOf(const SidePlan& plan, double feed) {
  std::vector<ToolMotion> motions;
  for (std::size_t p = 0; p < plan.path.size(); ++p) {
    motions.push_back({plan.path[p], plan.grinds[p] ? feed : 0.0});
  }
  return motions;
}

std::string rowsOf(const PlannedSide& planned) {
  std::ostringstream rows;
  for (const PlannedSetup& setup : planned.plan.setups) {
    rows << planned.coverage.blade << ',' << planned.coverage.side << ',' << setup.posture.lead << ','
         << setup.posture.tilt << ',' << setup.posture.slide << ',' << setup.runs << ',' << setup.poses << ','
         << 100.0 * setup.ground << '\n';
  }
  return rows.str();
}

void print(const PlannedSide& planned, const GrinderInput& input, const std::string& path) {
  const SidePlan& plan = planned.plan;
  std::cout << path << ": " << countedText(plan.path.size(), "pose", "poses") << " in "
            << countedText(plan.setups.size(), "setup", "setups") << '\n'
            << summaryText(planned.coverage, planned.coverage.blade) << '\n';
  constexpr double kWorthALine = 5e-4;  // 0.1 %, rounded
  for (const UnreachedArea& area : plan.unreached) {
    if (area.share < kWorthALine) continue;
    std::cout << "Not reached: " << shareText(area.share, 1.0) << " of the side, where the "
              << input.tool.parts[area.obstacle.part].name << " would be "
              << (area.obstacle.too_deep ? "too deep in " : "in contact with ")
              << input.names().nameOf(area.obstacle.blade) << '\n';
  }
}

int plan(const PlanRequest& request) {
  const GrinderFiles& files = request.files;
  requireNotRead(files, {"setups.csv"});
  const GrinderInput input = readGrinder(files);
  const BliskPlan blisk(request, input);
  const std::filesystem::path out = files.out;
  makeFolder(out);
  warnOfInput(files, input);
  TerminalWatch terminal(1000);
  std::vector<int> blades = {files.ground_blade.value_or(1)};
  if (request.all_blades) {
    blades.clear();
    for (int blade = 1; blade <= input.blades.count; ++blade) blades.push_back(blade);
  }
  const std::vector<std::string> sides = request.side == "both"
                                             ? std::vector<std::string>{"convex", "concave"}
                                             : std::vector<std::string>{request.side};
  std::string setups = "blade,side,lead_deg,tilt_deg,slide_mm,runs,poses,ground_percent\n";
  bool any_left_out = false;
  for (const int blade : blades) {
    for (const std::string& side : sides) {
      const PlannedSide planned = blisk.plan(blade, side, terminal);
      setups += rowsOf(planned);
      const std::string name = "blade-" + std::to_string(blade) + "-" + side;
      WholeFiles whole;
      const std::filesystem::path path = out / (name + "." + request.format);
      if (planned.plan.path.empty()) {
        std::cout << name << ": the tool can grind no part of the side\n";
        any_left_out = true;
      } else if (request.format == "apt") {
        writeClFile(whole.add(path), motionsOf(planned.plan, request.feed));
      } else {
        writeMotions(whole.add(path), motionsOf(planned.plan, request.feed));
      }
      writeCoverage(planned.coverage, whole.add(out / (name + "-coverage.csv")));
      writePng(coveragePicture(planned.coverage), whole.add(out / (name + "-coverage.png")).string());
      writeFile(whole.add(out / "setups.csv"), setups);
      whole.finish();
      print(planned, input, path.string());
      if (planned.plan.is_partial) {
        throw TerminalWatch::stopped("stopped: " + path.string() + " has the setups planned so far");
      }
    }
  }
  return any_left_out ? 1 : 0;
}

}  // namespace

void addPlanCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = addSubcommand(app, "plan");
  const auto request = std::make_shared<PlanRequest>();
  addGrinderOptions(command, request->files);
  addConvexOption(command, request->convex);
  addChoice(command, "--side", request->side, {"convex", "concave", "both"}, "Side of the blade to grind");
  command.add_flag("--all-blades", request->all_blades, "Plan a path for each blade of the blisk")
      ->excludes(command.get_option("--ground-blade"));
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
