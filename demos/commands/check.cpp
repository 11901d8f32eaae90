// octoblisk check: checks exactly whether two meshes collide, at each pose of a file.
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

#include "command_line/help.h"
#include "command_line/options.h"
#include "command_line/print_message.h"
#include "command_line/units_option.h"
#include "commands/check_summary.h"
#include "commands/commands.h"
#include "io/mesh_file.h"
#include "io/new_file.h"
#include "io/number_text.h"
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
  std::string units;  // empty: the unit of the poses
  PoseCheckOptions options;
};

ClusteredOctree treeOfFile(Ranks& ranks, const std::string& file, const CheckRequest& request) {
  return treeOncePerNode(ranks, [&] { return inMillimetres(readMesh(file), request.units, file); });
}

std::string columnsOf(const PoseCheckOptions& options) {
  return std::string("pose,colliding,triangle_fixed,triangle_moving") +
         (options.clearance ? ",clearance" : "") + (options.depth ? ",depth" : "") +
         (options.signed_distance ? ",signed_distance,by_x,by_y,by_z,by_rx,by_ry,by_rz" : "") +
         (options.continuous ? ",fraction" : "");
}

/// An empty field for no value.
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
    const bool has_motion = pose > 0;
    const double free = answer.hit_on_motion ? answer.hit_on_motion->fraction : 1.0;
    row += poseField(has_motion ? std::optional(free) : std::nullopt);
  }
  return row + '\n';
}

/// Throws naming the file that does not support depths.
std::unique_ptr<PoseCheck> poseCheck(const CheckRequest& request, const ClusteredOctree& fixed,
                                     const ClusteredOctree& moving) try {
  return std::make_unique<PoseCheck>(fixed, moving, request.options);
} catch (const std::invalid_argument& error) {
  throw std::runtime_error(request.fixed + ": " + error.what());
}

/// Everything that the table of answers depends on.
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

/// Returns the exit code; 0 on all ranks but the first.
int check(CheckRequest request) {
  Ranks ranks;
  PoseCheckOptions& options = request.options;
  if (options.threads == 0) options.threads = ranks.threadsEach();
  const SharedPoses moving_in_fixed = posesOncePerNode(ranks, request.poses);
  const ClusteredOctree fixed = treeOfFile(ranks, request.fixed, request);
  const ClusteredOctree moving = treeOfFile(ranks, request.moving, request);
  std::unique_ptr<PoseCheck> poses_check;
  ranks.together([&] { poses_check = poseCheck(request, fixed, moving); });
  if (ranks.isFirst()) {
    constexpr char kHasHoles[] =
        "the mesh has holes: a mesh inside it near them may be missed (octoblisk inspect shows the holes)";
    constexpr char kCancel[] = ": where parts that face opposite ways overlap, nothing is inside";
    if (!poses_check->isFixedSolid()) warnOf(request.fixed, kHasHoles);
    if (!poses_check->isMovingSolid()) warnOf(request.moving, kHasHoles);
    if (const std::string parts = poses_check->inwardPartsOfFixed(); !parts.empty())
      warnOf(request.fixed, parts + kCancel);
    if (const std::string parts = poses_check->inwardPartsOfMoving(); !parts.empty())
      warnOf(request.moving, parts + kCancel);
  }
  const Study study = studyOf(request, fixed, moving, moving_in_fixed.poses);
  const StudyOutcome outcome = runStudy(
      study, request.target, {request.fixed, request.moving, request.poses}, ranks,
      [&](ItemRange items) { return answerPoses(*poses_check, moving_in_fixed.poses, items, options); });
  if (!ranks.isFirst()) return 0;
  const CheckSummary summary = summaryOfTallies(outcome.tallies);
  const std::optional time_per_pose = outcome.time / static_cast<double>(outcome.answered);
  std::ostream& words = isStandardOutput(request.target.out) ? std::cerr : std::cout;
  print(words, summary, options, outcome.answered > 0 ? time_per_pose : std::nullopt);
  return summary.isClean() ? 0 : 1;
}

}  // namespace

void addCheckCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = addSubcommand(app, "check");
  const auto request = std::make_shared<CheckRequest>();
  const std::string mesh_help = ", in mesh units: .stl, .obj or .ply";
  addFile(command, "--fixed", request->fixed, "Mesh that stays in place" + mesh_help)->required();
  addFile(command, "--moving", request->moving, "Mesh that moves" + mesh_help)->required();
  addFile(command, "--poses", request->poses,
          "Poses of the moving mesh in the fixed mesh's frame, a CSV file x,y,z,qw,qx,qy,qz: a "
          "translation in mesh units and a unit quaternion")
      ->required();
  addUnitsOption(
      command, request->units,
      "Length unit of both meshes: mm, m, in, or auto, which selects each mesh's unit by its size. Poses, "
      "tolerance and results are then in mm. Default: all lengths share one unit, whichever it is");
  addOut(command, request->target.out,
         "CSV file to write, or - for standard output: "
         "pose,colliding,triangle_fixed,triangle_moving, all counted from 0. Where colliding is 1, "
         "the row names a triangle pair that meets. The columns of the options below follow");
  addShardOptions(command, request->target);
  PoseCheckOptions& options = request->options;
  command.add_flag(
      "--clearance", options.clearance,
      "Add the column clearance: the least distance between the surfaces, in mesh units; 0 where they meet");
  command.add_flag(
      "--depth", options.depth,
      "Add the column depth: the penetration depth, in mesh units, to within the tolerance. It is the "
      "greater of the depth of the deepest point of the moving mesh in the fixed one and that of the deepest "
      "point of the fixed mesh in the moving one; a point's depth is its distance from the other surface. "
      "The depth is 0 where the surfaces are apart or just touch, and where equal solids coincide. A depth "
      "above 0 without meeting surfaces means that one mesh is wholly inside the other. The fixed mesh must "
      "have no holes (octoblisk inspect shows them). If the moving mesh has holes, the command may miss "
      "a fixed mesh that is inside it near a hole");
  command.add_flag(
      "--signed", options.signed_distance,
      "Add the column signed_distance: the clearance where the meshes are apart, minus the "
      "penetration depth where they are not. Also add its derivatives: by_x,by_y,by_z by the "
      "translation of the moving mesh, by_rx,by_ry,by_rz by its rotation about its own origin, "
      "in radians about the fixed mesh's axes. One mesh must have no holes. If a mesh has holes, "
      "the command may miss the other mesh if it is inside near a hole");
  command.add_flag(
      "--continuous", options.continuous,
      "Add the column fraction: the fraction of the motion from the previous pose that is proved to keep the "
      "tolerance; 1 for the whole motion, empty at the first pose. On a motion the centre of the moving "
      "mesh's bounding box moves along a straight line, while the mesh rotates at a constant rate by the "
      "smaller of the two possible angles");
  addOption(command, "--tolerance", options.tolerance, "LENGTH", numberFrom(1e-9, 1e9),
            "Accuracy of depths, and the distance that motions must keep, in mesh units. Motions that "
            "slide at little more than this distance take long to prove");
  addOption(command, "--threads", options.threads, "N", wholeNumberFrom(0, 1024),
            "Number of threads; 0: all cores of the machine, or a share of them under mpirun. The "
            "answers are the same for any number");
  command.callback([request, &exit_code] { exit_code = check(*request); });
}

}  // namespace octoblisk::demos
