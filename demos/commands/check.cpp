// octoblisk check: tells for each pose of a file whether two meshes collide, exactly.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "command_line/option_checks.h"
#include "command_line/partition_option.h"
#include "command_line/study_options.h"
#include "command_line/subcommand_help.h"
#include "command_line/units_option.h"
#include "commands/check_summary.h"
#include "commands/commands.h"
#include "io/exact_number.h"
#include "io/mesh_file.h"
#include "io/new_file.h"
#include "octoblisk/batch.h"
#include "study/node_inputs.h"
#include "study/run_study.h"
#include "toolpath/pose_check.h"

namespace octoblisk::demos {
namespace {

struct CheckRequest {
  std::string fixed;
  std::string moving;
  std::string poses;
  StudyTarget target;
  std::string units;  // empty: those of the poses
  BuildOptions tree;
  PoseCheckOptions options;
};

ClusteredOctree treeOfFile(Ranks& ranks, const std::string& file, const CheckRequest& request) {
  return treeOnceANode(
      ranks, [&] { return inMillimetres(readMesh(file), request.units, file); }, request.tree);
}

std::string columnsOf(const PoseCheckOptions& options) {
  return std::string("pose,colliding,triangle_fixed,triangle_moving") +
         (options.clearance ? ",clearance" : "") + (options.depth ? ",depth" : "") +
         (options.signed_distance ? ",signed_distance,by_x,by_y,by_z,by_rx,by_ry,by_rz" : "") +
         (options.continuous ? ",fraction" : "");
}

/// Nothing for none.
std::string poseField(const std::optional<double>& value) { return value ? ',' + exactText(*value) : ","; }

std::string rowOfPose(std::size_t pose, const PoseAnswer& answer, const PoseCheckOptions& options) {
  std::string row = std::to_string(pose) + (answer.touching ? ",1," : ",0,");
  if (answer.touching) row += std::to_string(answer.touching->a);
  row += ',';
  if (answer.touching) row += std::to_string(answer.touching->b);
  if (options.clearance) row += poseField(answer.clearance);
  if (options.depth) row += poseField(answer.depth);
  if (options.signed_distance) {
    const SignedDistance& found = *answer.signed_distance;
    row += poseField(found.distance);
    for (const Vec3& by : {found.by_translation, found.by_rotation}) {
      for (const double component : by) row += poseField(component);
    }
  }
  if (options.continuous) {
    const bool has_way = pose > 0;
    const double free = answer.on_the_way ? answer.on_the_way->fraction : 1.0;
    row += poseField(has_way ? std::optional(free) : std::nullopt);
  }
  return row + '\n';
}

/// Says which file cannot be asked for depths.
std::unique_ptr<PoseCheck> poseCheck(const CheckRequest& request, const ClusteredOctree& fixed,
                                     const ClusteredOctree& moving) try {
  return std::make_unique<PoseCheck>(fixed, moving, request.options);
} catch (const std::invalid_argument& error) {
  throw std::runtime_error(request.fixed + ": " + error.what());
}

/// What the file of answers depends on.
Study studyOf(const CheckRequest& request, const ClusteredOctree& fixed, const ClusteredOctree& moving,
              std::span<const Pose> poses) {
  Study study;
  study.name = kCheckName;
  study.columns = columnsOf(request.options);
  study.items = poses.size();
  study.group = kPosesAtOnce;
  study.inputs = {{"fixed", fingerprintOf(fixed.mesh())},
                  {"moving", fingerprintOf(moving.mesh())},
                  {"poses", fingerprintOf(poses)}};
  // Of several pairs that meet, the tree decides which is told.
  if (request.tree.partition == PartitionKind::paper) {
    study.inputs.push_back({"clusters", static_cast<std::uint64_t>(request.tree.clusters)});
    study.inputs.push_back({"fnop", static_cast<std::uint64_t>(request.tree.leaf_capacity)});
  }
  study.options = optionsLine(request.options);
  return study;
}

std::vector<AnsweredGroup> answerPoses(PoseCheck& poses_check, std::span<const Pose> poses, ItemRange items,
                                       const PoseCheckOptions& options) {
  const std::vector<PoseAnswer> answers = poses_check.answer(poses, items.begin, items.end);
  std::vector<AnsweredGroup> groups;
  for (std::size_t begin = items.begin; begin < items.end; begin += kPosesAtOnce) {
    AnsweredGroup& group = groups.emplace_back();
    group.items = {begin, std::min(items.end, begin + kPosesAtOnce)};
    CheckSummary summary;
    for (std::size_t pose = begin; pose < group.items.end; ++pose) {
      const PoseAnswer& answer = answers[pose - items.begin];
      group.rows += rowOfPose(pose, answer, options);
      summary.count(pose, answer, options);
    }
    group.tally = tallyOf(summary);
  }
  return groups;
}

/// The exit code; 0 at all ranks but the first.
int check(CheckRequest request) {
  Ranks ranks;
  PoseCheckOptions& options = request.options;
  if (options.threads == 0) options.threads = ranks.threadsEach();
  const SharedPoses moving_in_fixed = posesOnceANode(ranks, request.poses);
  const ClusteredOctree fixed = treeOfFile(ranks, request.fixed, request);
  const ClusteredOctree moving = treeOfFile(ranks, request.moving, request);
  std::unique_ptr<PoseCheck> poses_check;
  ranks.together([&] { poses_check = poseCheck(request, fixed, moving); });
  const Study study = studyOf(request, fixed, moving, moving_in_fixed.poses);
  const StudyOutcome outcome = runStudy(
      study, request.target, {request.fixed, request.moving, request.poses}, ranks,
      [&](ItemRange items) { return answerPoses(*poses_check, moving_in_fixed.poses, items, options); });
  if (!ranks.isFirst()) return 0;
  const CheckSummary summary = summaryOfTallies(outcome.tallies);
  const std::optional a_pose = outcome.time / static_cast<double>(outcome.answered);
  std::ostream& words = isStandardOutput(request.target.out) ? std::cerr : std::cout;
  tell(words, summary, options, outcome.answered > 0 ? a_pose : std::nullopt);
  return summary.isClean() ? 0 : 1;
}

}  // namespace

void addCheckCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = addSubcommand(app, "check");
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
  addUnitsOption(command, request->units,
                 "The length unit of the two meshes: mm, m, in, or auto, which selects it of each by its "
                 "size; poses, tolerance and results are then in mm. Default: all is in one unit, whichever");
  addStudyOptions(command, request->target,
                  "CSV file to write, -: standard output: pose,colliding,triangle_fixed,triangle_moving, all "
                  "counted from 0; a pair "
                  "of triangles that meet where colliding is 1; then the columns of the options below");
  addPartitionOption(command, request->tree);
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
  command.add_flag(
      "--signed", options.signed_distance,
      "Columns signed_distance, the clearance where the meshes are apart, less the depth where they are not; "
      "and its derivative by the pose: by_x,by_y,by_z where the moving mesh is displaced, by_rx,by_ry,by_rz "
      "where it is turned about its own origin, by radians about the fixed mesh's axes. One mesh must be "
      "closed");
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
                  "Threads; 0: all that the machine has, or a share of them each under mpirun. The answers "
                  "are the same")
      ->capture_default_str()
      ->check(wholeNumberFrom(0, 1024));
  command.callback([request, &exit_code] { exit_code = check(*request); });
}

}  // namespace octoblisk::demos
