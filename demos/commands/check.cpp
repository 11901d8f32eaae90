// octoblisk check: tells for each pose of a file whether two meshes collide, exactly.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands/commands.h"
#include "commands/option_checks.h"
#include "models/mesh_file.h"
#include "report/progress_bar.h"
#include "toolpath/pose_check.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

struct CheckRequest {
  std::string fixed;
  std::string moving;
  std::string poses;
  std::string out;
  PoseCheckOptions options;
};

/// The most remarkable of the poses' numbers.
struct Extreme {
  double value = 0.0;
  std::size_t pose = 0;
};

struct CheckSummary {
  std::size_t poses = 0;
  std::size_t colliding = 0;       ///< surfaces meet
  std::size_t inside = 0;          ///< they do not, yet one mesh lies in the other
  std::size_t ways = 0;            ///< from a pose to the next
  std::size_t met_on_the_way = 0;  ///< ways that come within the tolerance
  std::size_t unsettled = 0;       ///< of these, not proved either way
  std::optional<Extreme> least_clearance, greatest_depth;
  std::chrono::duration<double, std::micro> time{};  ///< of all answers together

  bool isClean() const { return colliding + inside + met_on_the_way == 0; }
};

ClusteredOctree readTree(const std::string& file) {
  return ClusteredOctree::build(std::make_shared<const TriangleMesh>(readMesh(file)));
}

/// Opens the file for writing, which must be none of the files read. Throws std::runtime_error naming it.
std::ofstream openResult(const CheckRequest& request) {
  for (const std::string& input : {request.fixed, request.moving, request.poses}) {
    std::error_code ignored;  // there is no such file yet
    if (std::filesystem::equivalent(request.out, input, ignored)) {
      throw std::runtime_error(request.out + ": cannot be both read and written");
    }
  }
  if (request.out == "-") {
    throw std::runtime_error("-: the summary goes to standard output, the result to a file: name one");
  }
  std::ofstream result(request.out);
  if (!result) throw std::runtime_error(request.out + ": cannot be written");
  return result;
}

/// A number so that it is read back as it is; nothing for none.
std::string field(const std::optional<double>& value) {
  if (!value) return ",";
  std::ostringstream text;
  text << ',' << std::setprecision(17) << *value;
  return text.str();
}

void write(std::ostream& result, std::size_t pose, const PoseAnswer& answer,
           const PoseCheckOptions& options) {
  result << pose << ',' << (answer.touching ? '1' : '0') << ',';
  if (answer.touching) result << answer.touching->a;
  result << ',';
  if (answer.touching) result << answer.touching->b;
  if (options.clearance) result << field(answer.clearance);
  if (options.depth) result << field(answer.depth);
  if (options.continuous) {
    const bool has_way = pose > 0;
    const double free = answer.on_the_way ? answer.on_the_way->fraction : 1.0;
    result << field(has_way ? std::optional(free) : std::nullopt);
  }
  result << '\n';
}

void count(std::size_t pose, const PoseAnswer& answer, CheckSummary& summary) {
  summary.colliding += answer.touching.has_value();
  summary.inside += !answer.touching && answer.depth.value_or(0.0) > 0.0;
  summary.met_on_the_way += answer.on_the_way.has_value();
  summary.unsettled += answer.on_the_way && !answer.on_the_way->converged;
  std::optional<Extreme>&least = summary.least_clearance, &greatest = summary.greatest_depth;
  if (answer.clearance && (!least || *answer.clearance < least->value)) least = {*answer.clearance, pose};
  if (answer.depth && (!greatest || *answer.depth > greatest->value)) greatest = {*answer.depth, pose};
}

CheckSummary checkPoses(PoseCheck& poses_check, const std::vector<Pose>& poses,
                        const PoseCheckOptions& options, std::ostream& result) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kAtOnce = 256;
  CheckSummary summary;
  summary.poses = poses.size();
  summary.ways = options.continuous ? poses.size() - 1 : 0;
  result << "pose,colliding,triangle_fixed,triangle_moving" << (options.clearance ? ",clearance" : "")
         << (options.depth ? ",depth" : "") << (options.continuous ? ",fraction" : "") << '\n';
  ProgressBar progress(std::cerr, poses.size());
  for (std::size_t begin = 0; begin < poses.size(); begin += kAtOnce) {
    const std::size_t end = std::min(begin + kAtOnce, poses.size());
    const Clock::time_point start = Clock::now();
    const std::vector<PoseAnswer> answers = poses_check.answer(poses, begin, end);
    summary.time += Clock::now() - start;
    for (std::size_t i = 0; i < answers.size(); ++i) {
      write(result, begin + i, answers[i], options);
      count(begin + i, answers[i], summary);
    }
    progress.update(end);
  }
  return summary;
}

/// Says which file cannot be asked for depths.
PoseCheck poseCheck(const CheckRequest& request, const ClusteredOctree& fixed,
                    const ClusteredOctree& moving) try {
  return PoseCheck(fixed, moving, request.options);
} catch (const std::invalid_argument& error) {
  throw std::runtime_error(request.fixed + ": " + error.what());
}

CheckSummary check(const CheckRequest& request) {
  const std::vector<Pose> moving_in_fixed = readPoses(request.poses);
  const ClusteredOctree fixed = readTree(request.fixed);
  const ClusteredOctree moving = readTree(request.moving);
  PoseCheck poses_check = poseCheck(request, fixed, moving);
  std::ofstream result = openResult(request);  // after all input is known to be good: it empties the file
  const CheckSummary summary = checkPoses(poses_check, moving_in_fixed, request.options, result);
  result.close();
  if (!result) throw std::runtime_error(request.out + ": cannot be written to its end");
  return summary;
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

void tell(const CheckSummary& summary, const PoseCheckOptions& options) {
  std::cout << counted(summary.poses, "pose", "poses") << ": " << summary.colliding << " colliding, ";
  if (options.depth) std::cout << summary.inside << " with one mesh wholly inside the other, ";
  std::cout << summary.poses - summary.colliding - summary.inside << " clear; " << std::fixed
            << std::setprecision(2) << summary.time.count() / static_cast<double>(summary.poses)
            << " us a pose\n"
            << std::defaultfloat << std::setprecision(6);
  if (const auto& least = summary.least_clearance) {
    std::cout << "Least clearance: " << least->value << " at pose " << least->pose << '\n';
  }
  if (const auto& greatest = summary.greatest_depth) {
    std::cout << "Greatest depth: " << greatest->value << " at pose " << greatest->pose << '\n';
  }
  if (options.continuous) {
    std::cout << counted(summary.ways, "way", "ways")
              << " between poses: " << summary.ways - summary.met_on_the_way << " free, "
              << summary.met_on_the_way << " not proved to keep " << options.tolerance;
    if (summary.met_on_the_way > 0) {
      std::cout << " (" << summary.met_on_the_way - summary.unsettled << " come nearer, " << summary.unsettled
                << " undecided)";
    }
    std::cout << '\n';
  }
}

}  // namespace

void addCheckCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = *app.add_subcommand(
      "check",
      "Tell for each pose whether the surfaces of two meshes meet, exactly on their triangles; if asked,\n"
      "how far apart or how deep in each other they are, and whether the ways between poses are free.\n"
      "Lengths are in mesh units: both meshes and the poses must share them. One mesh wholly inside\n"
      "another does not meet it: ask for the depth to be told.");
  const auto request = std::make_shared<CheckRequest>();
  const std::string mesh_help = ", in mesh units: .stl, .obj or .ply";
  command.add_option("--fixed", request->fixed, "Mesh that stays" + mesh_help)->required()->check(notEmpty());
  command.add_option("--moving", request->moving, "Mesh that moves" + mesh_help)
      ->required()
      ->check(notEmpty());
  command
      .add_option(
          "--poses", request->poses,
          "Poses of the moving mesh in the fixed one's frame, CSV file: x,y,z,qw,qx,qy,qz, a translation "
          "in mesh units and a unit quaternion")
      ->required()
      ->check(notEmpty());
  command
      .add_option(
          "-o,--out", request->out,
          "CSV file to write: pose,colliding,triangle_fixed,triangle_moving, all counted from 0; a pair "
          "of triangles that meet where colliding is 1; then the columns of the options below")
      ->required()
      ->check(notEmpty());
  PoseCheckOptions& options = request->options;
  command.add_flag("--clearance", options.clearance,
                   "Column clearance: the least distance of the surfaces, in mesh units; 0 where they meet");
  command.add_flag(
      "--depth", options.depth,
      "Column depth: how deep the deepest point of one mesh lies inside the other, which is its distance "
      "from the other's surface, in mesh units, to the tolerance; the greater of both ways. It is 0 where "
      "surfaces are apart or just touch, and where equal solids coincide. Above 0 with surfaces that do not "
      "meet, one mesh is wholly inside the other. The fixed mesh must be closed; in an open moving one "
      "nothing is inside");
  command.add_flag("--continuous", options.continuous,
                   "Column fraction: of the way from the pose before, straight and turning evenly, the part "
                   "that is proved to keep the tolerance; 1 where all of it does, empty at the first pose");
  command
      .add_option("--tolerance", options.tolerance,
                  "Of depths, and the distance that ways must keep, in mesh units. Ways that slide at little "
                  "more than this take long to prove")
      ->capture_default_str()
      ->check(numberFrom(1e-9, 1e9));
  command
      .add_option("--threads", options.threads,
                  "Threads; 0: all that the machine has. The answers are the same")
      ->capture_default_str()
      ->check(wholeNumberFrom(0, 1024));
  command.footer(
      "Mesh files are read with coordinates rounded to 32-bit floats.\n"
      "Exit codes: 0 all poses clear, and with --continuous all ways between them free; 1 any pose where "
      "the\n"
      "surfaces meet, with --depth one mesh is inside the other, or with --continuous a way not proved "
      "free;\n"
      "2 bad input: no file is written then, and one of an earlier run stays as it was.");
  command.callback([request, &exit_code] {
    const CheckSummary summary = check(*request);
    tell(summary, request->options);
    exit_code = summary.isClean() ? 0 : 1;
  });
}

}  // namespace octoblisk::demos
