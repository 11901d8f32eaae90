// octoblisk check: tells for each pose of a file whether two meshes collide, exactly.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands/commands.h"
#include "commands/option_checks.h"
#include "models/mesh_file.h"
#include "octoblisk/collide.h"
#include "report/progress_bar.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

struct CheckRequest {
  std::string fixed;
  std::string moving;
  std::string poses;
  std::string out;
};

struct CheckSummary {
  std::size_t poses = 0;
  std::size_t colliding = 0;
  std::chrono::duration<double, std::micro> query_time{};  ///< of all queries together
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
  std::ofstream result(request.out);
  if (!result) throw std::runtime_error(request.out + ": cannot be written");
  return result;
}

CheckSummary checkPoses(const ClusteredOctree& fixed, const ClusteredOctree& moving,
                        const std::vector<Pose>& poses, std::ostream& result) {
  using Clock = std::chrono::steady_clock;
  CheckSummary summary{poses.size()};
  result << "pose,colliding,triangle_fixed,triangle_moving\n";
  ProgressBar progress(std::cerr, poses.size());
  for (std::size_t index = 0; index < poses.size(); ++index) {
    const Clock::time_point start = Clock::now();
    const std::optional<TrianglePair> pair = collide(fixed, moving, poses[index]);
    summary.query_time += Clock::now() - start;
    if (pair) {
      ++summary.colliding;
      result << index << ",1," << pair->a << ',' << pair->b << '\n';
    } else {
      result << index << ",0,,\n";
    }
    progress.update(index + 1);
  }
  return summary;
}

CheckSummary check(const CheckRequest& request) {
  const std::vector<Pose> moving_in_fixed = readPoses(request.poses);
  const ClusteredOctree fixed = readTree(request.fixed);
  const ClusteredOctree moving = readTree(request.moving);
  std::ofstream result = openResult(request);  // after all input is known to be good: it empties the file
  const CheckSummary summary = checkPoses(fixed, moving, moving_in_fixed, result);
  result.close();
  if (!result) throw std::runtime_error(request.out + ": cannot be written to its end");
  return summary;
}

void tell(const CheckSummary& summary) {
  std::cout << summary.poses << " poses: " << summary.colliding << " colliding, "
            << summary.poses - summary.colliding << " clear; " << std::fixed << std::setprecision(2)
            << summary.query_time.count() / static_cast<double>(summary.poses) << " us per query\n";
}

}  // namespace

void addCheckCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = *app.add_subcommand(
      "check",
      "Tell for each pose whether the surfaces of two meshes meet, exactly on their triangles.\n"
      "Lengths are in mesh units: both meshes and the poses must share them. One mesh wholly inside\n"
      "another does not meet it.");
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
          "of triangles that meet where colliding is 1")
      ->required()
      ->check(notEmpty());
  command.callback([request, &exit_code] {
    const CheckSummary summary = check(*request);
    tell(summary);
    exit_code = summary.colliding > 0 ? 1 : 0;
  });
}

}  // namespace octoblisk::demos
