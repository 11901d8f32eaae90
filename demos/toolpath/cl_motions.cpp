#include "toolpath/cl_motions.h"

#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

#include "io/new_file.h"
#include "octoblisk/closest_point.h"

namespace octoblisk::demos {
namespace {

Mat3 rotationOf(const Vec3& tool_axis, const Vec3& second_axis) {
  Mat3 rotation;
  rotation << tool_axis, second_axis.cross(tool_axis), second_axis;
  return rotation;
}

}  // namespace

std::vector<ToolMotion> toolMotionsOf(const ClFile& file) {
  std::vector<ToolMotion> motions;
  for (const ClMotion& motion : file.motions) {
    if (!motion.second_axis) {
      throw std::invalid_argument(
          "line " + std::to_string(motion.line) +
          ": the motion has no second axis, so the tool's turn about its own axis is unknown");
    }
    motions.push_back({{rotationOf(motion.tool_axis, *motion.second_axis), motion.position}, motion.feed});
  }
  return motions;
}

std::vector<ToolMotion> toolMotionsOf(const ClFile& file, const ClusteredOctree& blisk) {
  const std::size_t count = file.motions.size();
  std::vector<Vec3> second_axes(count, Vec3::Zero());  // zero: the surface does not determine it either
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count; ++k) {
    const ClMotion& motion = file.motions[k];
    const ClosestPoint closest = closestPoint(blisk, motion.position).value();
    if (closest.distance < least) {
      least = closest.distance;
      nearest = k;
    }
    if (motion.second_axis) {
      second_axes[k] = *motion.second_axis;
      continue;
    }
    const Vec3 across = motion.tool_axis.cross(motion.position - closest.point);
    constexpr double kMinSine = 0.01;
    if (across.norm() > kMinSine * closest.distance) second_axes[k] = across.normalized();
  }
  // From the motion nearest to the surface towards both ends.
  const auto follow = [&](std::size_t k, const Vec3& before) {
    const Vec3& tool_axis = file.motions[k].tool_axis;
    Vec3& axis = second_axes[k];
    if (file.motions[k].second_axis) return;
    if (axis.isZero()) {
      constexpr double kMinSine = 1e-6;  // smaller sines are lost to rounding
      const Vec3 square = before - before.dot(tool_axis) * tool_axis;
      axis = square.norm() > kMinSine ? square.normalized() : tool_axis.unitOrthogonal();
    }
    if (axis.dot(before) < 0.0) axis = -axis;
  };
  follow(nearest, second_axes[nearest]);
  for (std::size_t k = nearest + 1; k < count; ++k) follow(k, second_axes[k - 1]);
  for (std::size_t k = nearest; k-- > 0;) follow(k, second_axes[k + 1]);
  std::vector<ToolMotion> motions;
  for (std::size_t k = 0; k < count; ++k) {
    const ClMotion& motion = file.motions[k];
    motions.push_back({{rotationOf(motion.tool_axis, second_axes[k]), motion.position}, motion.feed});
  }
  return motions;
}

void writeGoto(std::ostream& stream, const char* word, const Pose& tool_in_blisk, double unit) {
  const auto write = [&](const char* before, const Vec3& v) {
    stream << before << v.x() << ',' << v.y() << ',' << v.z();
  };
  stream << word;
  write("/", tool_in_blisk.translation / unit);
  write(", $\n     ", tool_in_blisk.rotation.col(0));
  write(", $\n     ", tool_in_blisk.rotation.col(2));
}

void writeClFile(const std::filesystem::path& file, std::span<const ToolMotion> motions) {
  std::ostringstream stream;
  stream.precision(std::numeric_limits<double>::max_digits10);
  stream << "PARTNO OCTOBLISK\n"
            "$$ GOTO/x,y,z, tool axis i,j,k, axis of the contact wheel u,v,w\n"
            "UNITS/MM\nMULTAX/ON\n";
  double feed = 0.0;
  for (const ToolMotion& motion : motions) {
    if (motion.feed == 0.0) {
      stream << "RAPID\n";
    } else if (motion.feed != feed) {
      feed = motion.feed;
      stream << "FEDRAT/" << feed << ",MMPM\n";
    }
    writeGoto(stream, "GOTO", motion.tool_in_blisk, 1.0);
    stream << '\n';
  }
  stream << "FINI\n";
  writeFile(file, stream.str());
}

}  // namespace octoblisk::demos
