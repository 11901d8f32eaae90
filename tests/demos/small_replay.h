// A small replay to write and read back.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "demos/block.h"
#include "models/shared_tree.h"
#include "report/replay.h"

namespace octoblisk::demos {

/// A block as the blisk, a small block as the tool, three poses with a turn, and malicious names.
inline Replay smallReplay(const std::string& name = "part") {
  Replay replay;
  replay.command = "grind";
  replay.title = name;
  replay.verdicts = {{"clear", Tone::clear}, {"interference", Tone::interference}};
  replay.counts = {{"interference", 1, Tone::interference}};
  replay.blisk = treeOf(block(Vec3(5, 10, 15), 2));
  replay.blade_of_triangle.assign(replay.blisk->mesh().triangleCount(), 0);
  for (std::size_t t = 0; t < 4; ++t) replay.blade_of_triangle[t] = 1 + static_cast<int>(t % 2);
  replay.blade_count = 2;
  replay.ground_blade = 1;
  replay.parts = {{name, treeOf(block(Vec3(1, 1, 1), 1))}};
  replay.charts = {{.title = "clearance", .unit = "mm", .linear_within = 0.1, .limits = {{0.5, "near"}}}};
  ReplayTrack track{.name = "path"};
  for (int p = 0; p < 3; ++p) {
    ReplayPose pose;
    pose.tool_in_blisk.translation = Vec3(1.5 * p, -2.0, 40.0);
    // More than half a turn: the quaternions' signs must be chosen.
    pose.tool_in_blisk.rotation = Eigen::AngleAxisd(2.5 * p, Vec3::UnitZ()).toRotationMatrix();
    if (p == 1) {
      pose.verdict = 1;
      pose.contacts = {{1, 0, 2, Vec3(1, 2, 3), Vec3(0, 0, -1), 0.25},
                       {0, 0, 0, Vec3(4, 5, 6), Vec3(1, 0, 0), -0.5}};
      pose.worst = ReplayNearest{0, 2, 0.25, "forward"};
    }
    track.poses.push_back(pose);
  }
  track.series = {{.name = "clearance", .unit = "mm", .values = {1.0, 0.0, std::nan("")}}};
  track.findings = {{.at = 1.0, .verdict = 1, .part = 0, .blade = 2, .side = "forward", .value = 0.25},
                    {.at = 1.5, .verdict = 1, .motion_to = 2}};
  replay.tracks = {track};
  return replay;
}

}  // namespace octoblisk::demos
