#include "toolpath/cl_moves.h"

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

std::vector<ToolMove> toolMovesOf(const ClFile& file) {
  std::vector<ToolMove> moves;
  for (const ClMove& move : file.moves) {
    if (!move.second_axis) {
      throw std::invalid_argument(
          "line " + std::to_string(move.line) +
          ": the motion has no second axis, so the tool's turn about its own axis is unknown");
    }
    moves.push_back({{rotationOf(move.tool_axis, *move.second_axis), move.position}, move.feed});
  }
  return moves;
}

std::vector<ToolMove> toolMovesOf(const ClFile& file, const ClusteredOctree& blisk) {
  const std::size_t count = file.moves.size();
  std::vector<Vec3> second_axes(count, Vec3::Zero());  // zero: the surface does not determine it either
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count; ++k) {
    const ClMove& move = file.moves[k];
    const ClosestPoint closest = closestPoint(blisk, move.position).value();
    if (closest.distance < least) {
      least = closest.distance;
      nearest = k;
    }
    if (move.second_axis) {
      second_axes[k] = *move.second_axis;
      continue;
    }
    const Vec3 across = move.tool_axis.cross(move.position - closest.point);
    constexpr double kLeastSine = 0.01;
    if (across.norm() > kLeastSine * closest.distance) second_axes[k] = across.normalized();
  }
  // From the motion nearest to the surface towards both ends.
  const auto follow = [&](std::size_t k, const Vec3& before) {
    const Vec3& tool_axis = file.moves[k].tool_axis;
    Vec3& axis = second_axes[k];
    if (file.moves[k].second_axis) return;
    if (axis.isZero()) {
      constexpr double kLeastSine = 1e-6;  // smaller sines are lost to rounding
      const Vec3 square = before - before.dot(tool_axis) * tool_axis;
      axis = square.norm() > kLeastSine ? square.normalized() : tool_axis.unitOrthogonal();
    }
    if (axis.dot(before) < 0.0) axis = -axis;
  };
  follow(nearest, second_axes[nearest]);
  for (std::size_t k = nearest + 1; k < count; ++k) follow(k, second_axes[k - 1]);
  for (std::size_t k = nearest; k-- > 0;) follow(k, second_axes[k + 1]);
  std::vector<ToolMove> moves;
  for (std::size_t k = 0; k < count; ++k) {
    const ClMove& move = file.moves[k];
    moves.push_back({{rotationOf(move.tool_axis, second_axes[k]), move.position}, move.feed});
  }
  return moves;
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

void writeClFile(const std::filesystem::path& file, std::span<const ToolMove> moves) {
  std::ostringstream stream;
  stream.precision(std::numeric_limits<double>::max_digits10);
  stream << "PARTNO OCTOBLISK\n"
            "$$ GOTO/x,y,z, tool axis i,j,k, axis of the contact wheel u,v,w\n"
            "UNITS/MM\nMULTAX/ON\n";
  double feed = 0.0;
  for (const ToolMove& move : moves) {
    if (move.feed == 0.0) {
      stream << "RAPID\n";
    } else if (move.feed != feed) {
      feed = move.feed;
      stream << "FEDRAT/" << feed << ",MMPM\n";
    }
    writeGoto(stream, "GOTO", move.tool_in_blisk, 1.0);
    stream << '\n';
  }
  stream << "FINI\n";
  writeFile(file, stream.str());
}

}  // namespace octoblisk::demos
