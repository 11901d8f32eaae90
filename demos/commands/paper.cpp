// octoblisk paper: reruns the paper's experiments and compares its numbers with ours.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "build/paper/principal_box.h"
#include "command_line/grinder_input.h"
#include "command_line/help.h"
#include "command_line/options.h"
#include "command_line/units_option.h"
#include "commands/commands.h"
#include "io/progress_bar.h"
#include "models/embedded_assets.h"
#include "models/shared_tree.h"
#include "paper/belt_poses.h"
#include "paper/blisk_ranges.h"
#include "paper/claims.h"
#include "paper/cmm/cmm_section.h"
#include "paper/detection_replay.h"
#include "paper/detection_section.h"
#include "paper/errata.h"
#include "paper/figures.h"
#include "paper/nodes_section.h"
#include "paper/paper_model.h"
#include "paper/robot/robot_figures.h"
#include "paper/robot/robot_section.h"
#include "paper/split_plots.h"
#include "paper/split_times_section.h"
#include "paper/surface_points.h"
#include "render/document.h"
#include "render/plot.h"
#include "report/replay_files.h"
#include "toolpath/grinding_path.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

/// Parts of the report; combine them with |.
enum PaperPart : unsigned {
  kTable1 = 1,
  kTable2 = 2,
  kTable3 = 4,
  kTable4 = 8,
  kTable5 = 16,
  kFigures = 32,
  kAllParts = 63
};

struct PaperRequest {
  std::string blade;          ///< mesh file; empty: the built-in blisk
  std::string units;          ///< of the mesh file, as units_option.h reads it; empty: mm
  std::string out;            ///< folder; created if missing
  std::size_t points = 1900;  ///< of a blade
  std::uint64_t seed = 1;     ///< of clouds, clusters, poses, stock and noise
  int starts = 16;            ///< of k-means; 1 is the paper's method
};

constexpr double kLift = 1.0;             // mm, of the lifted path off the blade
constexpr std::size_t kPosesAbout = 400;  // seeded poses of the belt about the blade
constexpr double kReachOfPoses = 40.0;    // mm
constexpr std::size_t kSeeds = 32;        // of clouds and clusters, for the spread in Tables 1 to 4
constexpr int kRepeatsOfSeeds = 3;        // per timing

constexpr const char* kReplayFile = "replay.html";  // of Table 3

constexpr unsigned kOfSplits = kTable1 | kTable2 | kFigures;
constexpr unsigned kOfBlisk = kTable3 | kTable4 | kTable5;
constexpr unsigned kWithPlots = kTable4 | kTable5 | kFigures;

constexpr const char* kNoBlades = "no blades were found about the z axis";

/// The folder of the report: created if missing, and removed again if the run fails and it is empty.
class OutFolder {
 public:
  explicit OutFolder(const std::string& path) : path_(path) {
    std::error_code error;
    is_new_ = std::filesystem::create_directories(path_, error);
    if (error)
      throw std::runtime_error(path + ": cannot create the folder: " + error.message() +
                               ": choose another --out");
    if (::access(path_.c_str(), W_OK) != 0)
      throw std::runtime_error(path + ": the folder is not writable: choose another --out");
  }
  ~OutFolder() {
    std::error_code not_empty;
    if (is_new_) std::filesystem::remove(path_, not_empty);
  }
  OutFolder(const OutFolder&) = delete;
  OutFolder& operator=(const OutFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  bool is_new_ = false;
};

Points cloudOf(const PaperModel& model, const PaperRequest& request) {
  try {
    return evenPoints(*model.blade, request.points, request.seed);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(model.name + ": " + error.what());
  }
}

/// What one part adds to the report.
struct Findings {
  std::vector<Section> sections;
  std::vector<Claim> claims;

  void add(Section section, std::vector<Claim> of_section = {}) {
    sections.push_back(std::move(section));
    std::ranges::move(of_section, std::back_inserter(claims));
  }
};

/// Makes the sections in order, and shares between them the results that several need.
class PaperRun {
 public:
  PaperRun(const PaperRequest& request, PaperModel model, const std::filesystem::path& out)
      : request_(request),
        out_(out),
        model_(std::move(model)),
        cloud_(cloudOf(model_, request)),
        belt_(treeOf(paperBelt())) {}

  /// "blade 1 of the built-in blisk"
  std::string nameOfBlade() const { return model_.isBlisk() ? "blade 1 of " + model_.name : model_.name; }

  /// Tables 1 and 2, and figures 9 and 10.
  Findings splits(unsigned parts, const Progress& progress) const {
    const SplitRun run = runSplits(progress);
    Findings findings;
    if ((parts & kTable1) != 0) findings.add(nodesSection(run), nodesClaims(run));
    if ((parts & kTable2) != 0) findings.add(splitTimesSection(run), splitTimesClaims(run));
    if ((parts & kFigures) != 0) findings.add(splitPlotsSection(run, out_));
    if ((parts & (kTable1 | kTable2)) != 0) writeCsv(splitCells(run), out_);
    return findings;
  }

  Findings table3(const Progress& progress) const {
    const std::vector<Points> parts = clouds();
    const BliskRanges ranges = findBliskRanges(parts, kMeans());
    progress(0.1);
    const auto blisk = treeOf(model_.mesh);
    const DetectionScene scene{.model = model_,
                               .blisk = blisk,
                               .belt = belt_,
                               .ground = judged(*blisk, *belt_, grindingPath(0.0)),
                               .lifted = judged(*blisk, *belt_, grindingPath(kLift)),
                               .lift = kLift};
    const DetectionResult result =
        runDetectionExperiment(*blisk, *belt_, parts, scene.ground, scene.lifted, {.k_means = kMeans()},
                               stretchOf(progress, 0.1, 0.3));
    const DetectionSeeds seeds = detectionOverSeeds(
        [this](std::uint64_t seed) { return clouds(seed); }, principalBox(belt_->mesh().vertices()),
        grindingPath(0.0), {.count = kSeeds, .k_means = kMeans()}, stretchOf(progress, 0.3, 1.0));
    const Replay replay = detectionReplay(scene, result);
    writeReplayPage(replay, replayMeshesOf(replay), out_ / kReplayFile);
    Findings findings;
    findings.add(bliskRangesSection(ranges, static_cast<std::size_t>(model_.blades.count)));
    findings.add(detectionSection(result, seeds, model_.name, kLift), detectionClaims(result, seeds));
    sayWhatIsByConstruction(findings.sections.back());
    findings.sections.back().paragraphs.push_back(std::string(kReplayFile) +
                                                  ", beside this report, plays both paths in the browser.");
    return findings;
  }

  Findings table4(const Progress& progress) const {
    const RobotScene scene = robotScene(model_, clouds(), grindingPath(0.0));
    RobotRunOptions options;
    options.noise.seed = request_.seed;
    options.k_means = kMeans();
    const RobotReport report = runRobotExperiment(
        scene, model_.name, grindingPath(kLift), kLift, options,
        [this](std::uint64_t seed) { return clouds(seed); }, progress);
    Section section = robotSection(report);
    sayWhatIsByConstruction(section);
    section.figures = drawRobotFigures(report, scene, out_);
    return {{std::move(section)}, robotClaims(report)};
  }

  Findings table5(const Progress&) const {
    CmmExperimentOptions options;
    options.stock.seed = request_.seed;
    options.errors.seed = request_.seed + 1;
    options.cmm.seed = request_.seed + 2;
    const CmmRuns runs = runCmm(*model_.mesh, model_.blades, options);
    return {{cmmSection(*model_.mesh, model_.blades, runs, out_)}, cmmClaims(runs)};
  }

  Findings figures(const Progress& progress) const {
    return {figureSections(model_, belt_->mesh(), cloud_, request_.seed, out_, progress), {}};
  }

 private:
  std::vector<Points> clouds(std::uint64_t seed) const { return partClouds(model_, request_.points, seed); }
  std::vector<Points> clouds() const { return clouds(request_.seed); }
  KMeansOptions kMeans() const { return {.k = 2, .seed = request_.seed, .starts = request_.starts}; }

  void sayWhatIsByConstruction(Section& section) const {
    if (!request_.blade.empty()) return;
    section.paragraphs.push_back(
        "By construction: the built-in blisk is as large as the paper's, 480 × 480 × 200 mm. Only for that "
        "reason does its traditional range agree with the paper's.");
  }

  /// The grinding path, lifted off the blade by `lift`.
  std::vector<Pose> grindingPath(double lift) const {
    GrindingPathOptions path;
    if (lift > 0.0) path.depth = -lift;
    return makeGrindingPath(*model_.mesh, model_.blades, path);
  }

  SplitRun runSplits(const Progress& progress) const {
    const Obb belt_box = principalBox(belt_->mesh().vertices());
    const std::vector<BeltPose> poses =
        posesAbout(*treeOf(model_.blade), *belt_, kPosesAbout, kReachOfPoses, request_.seed);
    SplitRun run{.blade_name = nameOfBlade(),
                 .points = cloud_.size(),
                 .result = runSplitExperiment(cloud_, belt_box, poses, {.k_means = kMeans()},
                                              stretchOf(progress, 0.0, 0.3))};
    for (std::size_t i = 0; i < kSeeds; ++i) {
      KMeansOptions k_means = kMeans();
      k_means.seed += i;
      run.of_seeds.push_back(
          runSplitExperiment(evenPoints(*model_.blade, request_.points, k_means.seed), belt_box, {},
                             {.k_means = k_means, .repeats = kRepeatsOfSeeds}, [](double) {}));
      progress(0.3 + 0.7 * static_cast<double>(i + 1) / kSeeds);
    }
    return run;
  }

  const PaperRequest& request_;
  const std::filesystem::path& out_;
  PaperModel model_;
  Points cloud_;
  std::shared_ptr<const ClusteredOctree> belt_;
};

PaperModel modelOf(const PaperRequest& request) {
  return request.blade.empty() ? paperModel("the built-in blisk", embeddedBlisk())
                               : paperModel(request.blade, readUsersMesh(request.blade, request.units));
}

Document titlePage(const std::string& blade, std::uint64_t seed) {
  return {
      .title = "The paper's experiments, rerun",
      .paragraphs = {"This report reruns the experiments of Z. Huang et al., Collision detection algorithm "
                     "of belt grinding of the Blisk based on improved octree segmentation method, on " +
                     blade +
                     ", and compares the paper's numbers with ours. Nothing is tuned to match them. Apart "
                     "from times, all results repeat exactly for the same --seed, " +
                     std::to_string(seed) + " here."}};
}

/// Writes the report into the folder. When all parts are asked for, those that do not apply to the mesh are
/// left out, and the report says so. Warnings and a progress bar go to `messages`.
///
/// Throws std::invalid_argument for a mesh that cannot be read, or that does not support a part asked for by
/// name; std::runtime_error if gnuplot is missing or the folder is not writable. If it throws, a folder that
/// it created is removed again, unless it has files in it.
void runPaper(const PaperRequest& request, unsigned parts, std::ostream& messages) {
  if ((parts & kWithPlots) != 0) requireGnuplot();
  PaperModel model = modelOf(request);
  const bool all = parts == kAllParts;
  const std::string name = model.name;
  const bool no_blisk = (parts & kOfBlisk) != 0 && !model.isBlisk();
  if (no_blisk && !all) {
    throw std::invalid_argument(name + ": " + kNoBlades +
                                ", so there is no grinding path: Tables 3 to 5 need a blisk");
  }
  const std::string left_out =
      kNoBlades + std::string(": it is treated as one blade; Tables 3 to 5 need a blisk and are left out");
  if (no_blisk) {
    messages << "octoblisk: warning: " << name << ": " << left_out << '\n';
    parts &= ~kOfBlisk;
  }
  const OutFolder out(request.out);
  const PaperRun run(request, std::move(model), out.path());
  Document document = titlePage(run.nameOfBlade(), request.seed);
  if (no_blisk) document.paragraphs.push_back("In this mesh, " + left_out + ".");

  struct Step {
    unsigned parts;
    double work;  // roughly, in seconds
    std::string title;
    std::function<Findings(const Progress&)> run;
  };
  std::vector<Step> steps = {
      {kOfSplits, 12.0, "", [&](const Progress& progress) { return run.splits(parts, progress); }},
      {kTable3, 10.0, "", [&](const Progress& progress) { return run.table3(progress); }},
      {kTable4, 40.0, "Table 4", [&](const Progress& progress) { return run.table4(progress); }},
      {kTable5, 10.0, "Table 5", [&](const Progress& progress) { return run.table5(progress); }},
      {kFigures, 10.0, "", [&](const Progress& progress) { return run.figures(progress); }}};
  std::erase_if(steps, [parts](const Step& step) { return (step.parts & parts) == 0; });
  double work = 0.0, done = 0.0;
  for (const Step& step : steps) work += step.work;

  constexpr double kTicks = 1000;
  ProgressBar bar(messages, static_cast<std::size_t>(kTicks));
  const Progress progress = [&bar](double part) { bar.update(static_cast<std::size_t>(part * kTicks)); };
  Findings found;
  for (const Step& step : steps) {
    try {
      Findings part = step.run(stretchOf(progress, done / work, (done + step.work) / work));
      for (Section& section : part.sections) found.add(std::move(section));
      std::ranges::move(part.claims, std::back_inserter(found.claims));
    } catch (const std::invalid_argument& error) {  // e.g. the arm does not reach, or a blade is too small
      if (!all || step.title.empty()) throw;
      document.paragraphs.push_back(step.title + " is left out: " + error.what() + ".");
    }
    done += step.work;
    progress(done / work);
  }
  if (!found.claims.empty()) document.sections.push_back(claimsSection(found.claims));
  std::ranges::move(found.sections, std::back_inserter(document.sections));
  document.sections.push_back(errataSection());
  writeReport(document, out.path());
}

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
  addFile(command, "--blade", request.blade,
          "Mesh file: a blisk about the Z axis, whose blade 1 is used, or a single blade. Default: "
          "the built-in blisk");
  addUnitsOption(command, request.units);
  addOption(command, "--points", request.points, "N", wholeNumberFrom(kMinPoints, kMaxPoints),
            "Number of points on a blade; the paper does not give it");
  addOption(command, "--seed", request.seed, "N", wholeNumberFrom(0, std::int64_t{1} << 62),
            "Seed of clouds, clusters, poses, stock and noise");
  addOption(command, "--starts", request.starts, "N", wholeNumberFrom(1, 1000),
            "Number of k-means runs, each from different initial centres; the best by eq. 5 counts. 1 "
            "is the paper's method");
  addOut(command, request.out, "Folder for the report, tables and figures; created if missing", "DIR");
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
