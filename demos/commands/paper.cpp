// octoblisk paper: reruns the paper's experiments and compares its numbers with ours.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
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
#include "paper/cmm/cmm_numbers.h"
#include "paper/detection_replay.h"
#include "paper/detection_seeds.h"
#include "paper/figures.h"
#include "paper/paper_model.h"
#include "paper/report.h"
#include "paper/robot/robot_report.h"
#include "paper/split_experiment.h"
#include "paper/surface_points.h"
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

/// By the bits of PaperPart.
constexpr const char* kNameOfPart[] = {"table1", "table2", "table3", "table4", "table5", "figures"};

constexpr unsigned kOfSplits = kTable1 | kTable2 | kFigures;
constexpr unsigned kOfBlisk = kTable3 | kTable4 | kTable5;
constexpr unsigned kWithPlots = kTable4 | kTable5 | kFigures;

constexpr const char* kNoBlades = "no blades were found about the z axis";

/// The folder of the report: created if missing, and removed again if the run fails and it is empty.
class OutFolder {
 public:
  explicit OutFolder(const std::string& path) : path_(path) {
    std::error_code error;
    is_new_ = !std::filesystem::exists(path_, error);
    makeFolder(path_);
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

/// Runs the experiments in order, and shares between them what several need.
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
  nlohmann::json splits(const Progress& progress) const {
    const Obb belt_box = principalBox(belt_->mesh().vertices());
    const std::vector<BeltPose> poses =
        posesAbout(*treeOf(model_.blade), *belt_, kPosesAbout, kReachOfPoses, request_.seed);
    nlohmann::json numbers = {{"points", cloud_.size()},
                              {"result", runSplitExperiment(cloud_, belt_box, poses, {.k_means = kMeans()},
                                                            stretchOf(progress, 0.0, 0.3))}};
    for (std::size_t i = 0; i < kSeeds; ++i) {
      KMeansOptions k_means = kMeans();
      k_means.seed += i;
      numbers["of_seeds"].push_back(
          runSplitExperiment(evenPoints(*model_.blade, request_.points, k_means.seed), belt_box, {},
                             {.k_means = k_means, .repeats = kRepeatsOfSeeds}, [](double) {})
              .cubes);
      progress(0.3 + 0.7 * static_cast<double>(i + 1) / kSeeds);
    }
    return numbers;
  }

  nlohmann::json table3(const Progress& progress) const {
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
    writeReplayPage(replay, replayMeshesOf(replay), out_ / "replay.html");
    return {{"blades", model_.blades.count}, {"ranges", ranges}, {"result", result}, {"seeds", seeds}};
  }

  nlohmann::json table4(const Progress& progress) const {
    const RobotScene scene = robotScene(model_, clouds(), grindingPath(0.0));
    RobotRunOptions options;
    options.noise.seed = request_.seed;
    options.k_means = kMeans();
    const RobotReport report = runRobotExperiment(
        scene, grindingPath(kLift), options, [this](std::uint64_t seed) { return clouds(seed); }, progress);
    drawRobotCell(report, scene, out_ / "table4_cell.png");
    return report;
  }

  nlohmann::json table5(const Progress&) const {
    CmmExperimentOptions options;
    options.stock.seed = request_.seed;
    options.errors.seed = request_.seed + 1;
    options.cmm.seed = request_.seed + 2;
    return cmmNumbers(*model_.mesh, model_.blades, options);
  }

  nlohmann::json figures(const Progress& progress) const {
    return drawFigures(model_, belt_->mesh(), cloud_, request_.seed, out_, progress);
  }

 private:
  std::vector<Points> clouds(std::uint64_t seed) const { return partClouds(model_, request_.points, seed); }
  std::vector<Points> clouds() const { return clouds(request_.seed); }
  KMeansOptions kMeans() const { return {.k = 2, .seed = request_.seed, .starts = request_.starts}; }

  /// The grinding path, lifted off the blade by `lift`.
  std::vector<Pose> grindingPath(double lift) const {
    GrindingPathOptions path;
    if (lift > 0.0) path.depth = -lift;
    return makeGrindingPath(*model_.mesh, model_.blades, path);
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
  nlohmann::json numbers = {
      {"blade", run.nameOfBlade()},           {"model", name}, {"built_in", request.blade.empty()},
      {"seed", std::to_string(request.seed)}, {"lift", kLift}, {"parts", nlohmann::json::array()},
      {"notes", nlohmann::json::array()}};
  if (no_blisk) numbers["notes"].push_back("In this mesh, " + left_out + ".");

  struct Step {
    unsigned parts;
    double work;  // roughly, in seconds
    const char* name;
    const char* left_out;  // the title of a part that may be left out
    nlohmann::json (PaperRun::*run)(const Progress&) const;
  };
  std::vector<Step> steps = {{kOfSplits, 12.0, "splits", nullptr, &PaperRun::splits},
                             {kTable3, 10.0, "table3", nullptr, &PaperRun::table3},
                             {kTable4, 40.0, "table4", "Table 4", &PaperRun::table4},
                             {kTable5, 10.0, "table5", "Table 5", &PaperRun::table5},
                             {kFigures, 10.0, "figures", nullptr, &PaperRun::figures}};
  std::erase_if(steps, [parts](const Step& step) { return (step.parts & parts) == 0; });
  double work = 0.0, done = 0.0;
  for (const Step& step : steps) work += step.work;

  constexpr double kTicks = 1000;
  ProgressBar bar(messages, static_cast<std::size_t>(kTicks));
  const Progress progress = [&bar](double part) { bar.update(static_cast<std::size_t>(part * kTicks)); };
  for (const Step& step : steps) {
    try {
      numbers[step.name] = (run.*step.run)(stretchOf(progress, done / work, (done + step.work) / work));
    } catch (const std::invalid_argument& error) {  // e.g. the arm does not reach, or a blade is too small
      if (!all || step.left_out == nullptr) throw;
      numbers["notes"].push_back(step.left_out + std::string(" is left out: ") + error.what() + ".");
      parts &= ~step.parts;
    }
    done += step.work;
    progress(done / work);
  }
  for (std::size_t part = 0; part < std::size(kNameOfPart); ++part) {
    if ((parts >> part & 1) != 0) numbers["parts"].push_back(kNameOfPart[part]);
  }
  writePaperReport(paperReport(numbers), out.path());
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
