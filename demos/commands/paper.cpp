// octoblisk paper: runs the paper's experiments again and sets its numbers beside ours.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands/commands.h"
#include "commands/option_checks.h"
#include "models/embedded_assets.h"
#include "models/mesh_file.h"
#include "models/shared_tree.h"
#include "octoblisk/obb.h"
#include "paper/belt_poses.h"
#include "paper/blisk_ranges.h"
#include "paper/cmm_section.h"
#include "paper/detection_section.h"
#include "paper/errata.h"
#include "paper/figures.h"
#include "paper/paper_model.h"
#include "paper/robot_figures.h"
#include "paper/split_section.h"
#include "paper/surface_points.h"
#include "report/document.h"
#include "report/plot.h"
#include "report/progress_bar.h"
#include "toolpath/grinding_path.h"

namespace octoblisk::demos {
namespace {

constexpr int kLeastPoints = 100, kMostPoints = 10'000;
constexpr double kLift = 1.0;             // mm, of the path held off the blade
constexpr std::size_t kPosesAbout = 400;  // seeded poses of the belt about the blade
constexpr double kReachOfPoses = 40.0;    // mm
constexpr std::size_t kSeeds = 5;         // other clouds and clusterings for Table 1

constexpr const char* kNoBlisk =
    "no blades were found round the z axis: it is taken for one blade, and Tables 3 to 5, which need a "
    "blisk, "
    "are left out";

enum Part : unsigned {
  kTable1 = 1,
  kTable2 = 2,
  kTable3 = 4,
  kTable4 = 8,
  kTable5 = 16,
  kFigures = 32,
  kAll = 63
};
constexpr unsigned kOfBlisk = kTable3 | kTable4 | kTable5;

struct PaperRequest {
  std::string blade;  // file; empty: the built-in blisk
  std::string out;
  std::size_t points = 1900;
  std::uint64_t seed = 1;
};

/// What several parts need, found once.
struct Subject {
  PaperModel model;
  Points cloud;
  std::shared_ptr<const ClusteredOctree> belt;
};

Subject subjectOf(const PaperRequest& request) {
  Subject subject;
  subject.model = request.blade.empty() ? paperModel("the built-in blisk", embeddedBlisk())
                                        : paperModel(request.blade, readMesh(request.blade));
  subject.cloud = evenPoints(*subject.model.blade, request.points, request.seed);
  subject.belt = treeOf(paperBelt());
  return subject;
}

std::string nameOfBlade(const PaperModel& model) {
  return model.isBlisk() ? "blade 1 of " + model.name : model.name;
}

SplitRun runSplits(const Subject& subject, const PaperRequest& request, const Progress& progress) {
  const Obb belt_box = principalBox(subject.belt->mesh().vertices());
  const std::vector<BeltPose> poses =
      posesAbout(*treeOf(subject.model.blade), *subject.belt, kPosesAbout, kReachOfPoses, request.seed);
  SplitRun run{.blade_name = nameOfBlade(subject.model),
               .points = subject.cloud.size(),
               .result = runSplitExperiment(subject.cloud, belt_box, poses, {.seed = request.seed},
                                            stretchOf(progress, 0.0, 0.7))};
  for (std::uint64_t other = 1; other <= kSeeds; ++other) {
    const std::uint64_t seed = request.seed + other;
    run.ratios_of_seeds.push_back(nodeRatios(evenPoints(*subject.model.blade, request.points, seed), seed));
    progress(0.7 + 0.3 * static_cast<double>(other) / kSeeds);
  }
  return run;
}

/// The path as it is ground, or held off the blade.
std::vector<Pose> grindingPath(const PaperModel& model, bool lifted) {
  GrindingPathOptions path;
  if (lifted) path.depth = -kLift;
  return makeGrindingPath(*model.mesh, model.blades, path);
}

std::vector<Section> runTable3(const Subject& subject, const std::vector<Points>& parts,
                               const PaperRequest& request, const Progress& progress) {
  const PaperModel& model = subject.model;
  const BliskRanges ranges = findBliskRanges(parts, request.seed);
  progress(0.4);
  const auto blisk = treeOf(model.mesh);
  const std::vector<BeltPose> ground = judged(*blisk, *subject.belt, grindingPath(model, false));
  const std::vector<BeltPose> lifted = judged(*blisk, *subject.belt, grindingPath(model, true));
  const DetectionResult result = runDetectionExperiment(
      *blisk, *subject.belt, parts, ground, lifted, {.seed = request.seed}, stretchOf(progress, 0.4, 1.0));
  return {bliskRangesSection(ranges, static_cast<std::size_t>(model.blades.count)),
          detectionSection(result, model.name, kLift)};
}

Section runTable4(const PaperModel& model, std::vector<Points> parts, const PaperRequest& request,
                  const std::filesystem::path& out, const Progress& progress) {
  const RobotScene scene = robotScene(model, std::move(parts), grindingPath(model, false));
  RobotRunOptions options;
  options.noise.seed = request.seed;
  const RobotReport report =
      runRobotExperiment(scene, model.name, grindingPath(model, true), kLift, options, progress);
  Section section = robotSection(report);
  section.figures = drawRobotFigures(report, scene, out);
  return section;
}

Section runTable5(const PaperModel& model, const PaperRequest& request, const std::filesystem::path& out) {
  CmmExperimentOptions options;
  options.stock.seed = request.seed;
  options.errors.seed = request.seed + 1;
  options.cmm.seed = request.seed + 2;
  return cmmSection(*model.mesh, model.blades, out, options);
}

void requireBlisk(const PaperModel& model) {
  if (model.isBlisk()) return;
  throw std::invalid_argument(model.name +
                              ": no blades were found round the z axis, so there is no grinding path over "
                              "them: Tables 3 to 5 need a blisk");
}

std::filesystem::path madeFolder(const std::string& out) {
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) throw std::runtime_error(out + ": the folder cannot be made: " + error.message());
  return out;
}

void run(const PaperRequest& request, unsigned parts) {
  if ((parts & (kTable4 | kTable5 | kFigures)) != 0) requireGnuplot();
  const Subject subject = subjectOf(request);
  if (parts != kAll && (parts & kOfBlisk) != 0) requireBlisk(subject.model);
  const unsigned of_blisk = subject.model.isBlisk() ? parts & kOfBlisk : 0;
  const bool left_out = of_blisk != (parts & kOfBlisk);
  if (left_out) {
    std::cerr << "octoblisk: warning: " << subject.model.name << ": " << kNoBlisk << '\n';
  }
  const std::filesystem::path out = madeFolder(request.out);

  constexpr std::size_t kSteps = 1000;
  ProgressBar bar(std::cerr, kSteps);
  const Progress progress = [&bar](double part) { bar.update(static_cast<std::size_t>(part * kSteps)); };

  Document document{
      .title = "The paper, run again",
      .paragraphs = {
          "Z. Huang et al., Collision detection algorithm of belt grinding of the Blisk based on improved "
          "octree segmentation method: its experiments on " +
          nameOfBlade(subject.model) +
          ", its numbers beside ours. Nothing is tuned to look like it; all "
          "that is not a time is the same again for the same --seed, " +
          std::to_string(request.seed) + " here."}};
  if (left_out) document.paragraphs.push_back("Of this mesh " + std::string(kNoBlisk) + ".");
  if ((parts & (kTable1 | kTable2 | kFigures)) != 0) {
    const SplitRun split = runSplits(subject, request, stretchOf(progress, 0.0, 0.3));
    if ((parts & kTable1) != 0) document.sections.push_back(nodesSection(split));
    if ((parts & kTable2) != 0) document.sections.push_back(timesSection(split));
    if ((parts & kFigures) != 0) document.sections.push_back(splitPlotsSection(split, out));
    if ((parts & (kTable1 | kTable2)) != 0) writeCsv(splitCells(split), out);
  }
  std::vector<Points> clouds;
  if ((of_blisk & (kTable3 | kTable4)) != 0) clouds = partClouds(subject.model, request.points, request.seed);
  if ((of_blisk & kTable3) != 0) {
    for (Section& section : runTable3(subject, clouds, request, stretchOf(progress, 0.3, 0.5))) {
      document.sections.push_back(std::move(section));
    }
  }
  if ((of_blisk & kTable4) != 0) {
    try {
      document.sections.push_back(
          runTable4(subject.model, std::move(clouds), request, out, stretchOf(progress, 0.5, 0.7)));
    } catch (const std::invalid_argument& error) {  // the arm may not reach over a larger blisk
      if (parts != kAll) throw;
      document.paragraphs.push_back("Table 4 is left out: " + std::string(error.what()) + ".");
    }
  }
  if ((of_blisk & kTable5) != 0) {
    try {
      document.sections.push_back(runTable5(subject.model, request, out));
    } catch (const std::invalid_argument& error) {  // a blade may be too small for the sections
      if (parts != kAll) throw;
      document.paragraphs.push_back("Table 5 is left out: " + std::string(error.what()) + ".");
    }
    progress(0.8);
  }
  if ((parts & kFigures) != 0) {
    for (Section& section : figureSections(subject.model, subject.belt->mesh(), subject.cloud, request.seed,
                                           out, stretchOf(progress, 0.8, 1.0))) {
      document.sections.push_back(std::move(section));
    }
  }
  document.sections.push_back(errataSection());
  writeReport(document, out);
}

struct Named {
  const char* name;
  unsigned parts;
  const char* help;
};

constexpr Named kSubcommands[] = {
    {"table1", kTable1,
     "Nodes of traditional and improved octrees over one blade, with volumes and false alarms"},
    {"table2", kTable2, "Times to split"},
    {"table3", kTable3,
     "Detection over the grinding path of the blisk: range, time, false alarms and misses"},
    {"table4", kTable4, "The same in the loop of a simulated robot, with its errors and times"},
    {"table5", kTable5, "A blade measured before and after a simulated grinding pass"},
    {"figures", kFigures, "Figures 2, 4, 5, 8, 9 and 10"},
    {"all", kAll, "All of these in one report"}};

}  // namespace

void addPaperCommand(CLI::App& app, int& exit_code) {
  CLI::App& paper =
      *app.add_subcommand("paper",
                          "Run the experiments of Z. Huang et al., Collision detection algorithm of belt "
                          "grinding of the Blisk based on\n"
                          "improved octree segmentation method, again, and set its numbers beside ours");
  paper.require_subcommand(1);
  for (const Named& named : kSubcommands) {
    CLI::App& command = *paper.add_subcommand(named.name, named.help);
    const auto request = std::make_shared<PaperRequest>();
    command
        .add_option(
            "--blade", request->blade,
            "Mesh file (mm): a blisk round the axis Z, of which blade 1 is taken, or a blade alone; default: "
            "the built-in blisk")
        ->check(notEmpty());
    command
        .add_option("--points", request->points,
                    "Points of the blade; the paper does not say how many it has")
        ->check(wholeNumberFrom(kLeastPoints, kMostPoints))
        ->capture_default_str();
    command.add_option("--seed", request->seed, "Of the clouds, the clusters and the poses")
        ->check(wholeNumberFrom(0, std::int64_t{1} << 62))
        ->capture_default_str();
    command.add_option("-o,--out", request->out, "Folder for report, tables and figures; made where missing")
        ->required()
        ->check(notEmpty());
    command.footer(
        "Written to OUT: report.md, report.html (which needs no other file), every table as CSV, figures as "
        "SVG\n"
        "and PNG.\n"
        "Exit codes: 0 done, 2 bad input.");
    command.callback([request, parts = named.parts, &exit_code] {
      run(*request, parts);
      const std::filesystem::path out = request->out;
      std::cout << "Report: " << (out / "report.html").string() << ", " << (out / "report.md").string()
                << '\n';
      exit_code = 0;
    });
  }
}

}  // namespace octoblisk::demos
