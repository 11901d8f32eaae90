#include "command_line/blisk_options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "command_line/options.h"
#include "io/quoted_text.h"
#include "models/length_limit.h"

namespace octoblisk::demos {
namespace {

BliskAxis axisOf(const std::string& text) {
  const auto refuse = [&] {
    throw std::invalid_argument("--axis: " + inQuotes(text) +
                                " is neither a direction x,y,z nor a direction and a point x,y,z,px,py,pz");
  };
  std::vector<double> numbers;
  std::string_view rest = text;
  for (bool more = true; more;) {
    if (rest.starts_with('+')) rest.remove_prefix(1);
    double number = 0.0;
    const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (error != std::errc{} || !(std::abs(number) <= kMaxLength)) refuse();
    numbers.push_back(number);
    rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
    more = rest.starts_with(',');
    if (more) rest.remove_prefix(1);
  }
  if (!rest.empty() || (numbers.size() != 3 && numbers.size() != 6)) refuse();
  BliskAxis axis{Vec3(numbers[0], numbers[1], numbers[2]), Vec3::Zero()};
  if (axis.direction.isZero(0.0)) refuse();
  if (numbers.size() == 6) axis.point = Vec3(numbers[3], numbers[4], numbers[5]);
  return axis;
}

}  // namespace

void addBliskOptions(CLI::App& command, std::string& blisk, std::string& axis) {
  addFile(command, "--blisk", blisk, "Mesh file of the blisk, in any position. Default: the built-in blisk");
  addFile(command, "--axis", axis,
          "Axis of the blisk, x,y,z[,px,py,pz]: the direction from leading to trailing edge, and a "
          "point on the axis (0,0,0 if not given), in the mesh's frame. Default: found from the mesh",
          "AXIS");
}

void addConvexOption(CLI::App& command, std::string& convex) {
  addChoice(command, "--convex", convex, {"forward", "backward"},
            "Convex side of the blades: forward, towards greater angles, or backward. Default: found "
            "from the blades' camber");
}

BliskFound bliskAbout(const std::string& axis, const TriangleMesh& mesh, const std::string& mesh_name) {
  if (axis.empty()) {
    try {
      return findBlisk(mesh);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(mesh_name + ": " + error.what() +
                               "; if it is a blisk, give its axis with --axis");
    }
  }
  const BliskAxis given = axisOf(axis);
  try {
    return findBlisk(mesh, given);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(mesh_name + ": " + error.what());
  }
}

BliskAnatomy anatomyOf(const TriangleMesh& blisk, const BladesFound& blades, const std::string& mesh_name) {
  try {
    return findAnatomy(blisk, blades);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(mesh_name + ": " + error.what());
  }
}

BladeSide convexSide(const std::string& convex, const BliskAnatomy& anatomy, const std::string& mesh_name) {
  if (convex == "forward") return BladeSide::forward;
  if (convex == "backward") return BladeSide::backward;
  if (anatomy.convex_side) return *anatomy.convex_side;
  throw std::runtime_error(mesh_name +
                           ": the blades are too straight to find their convex side: give it with --convex");
}

BladeRegion regionNamed(const std::string& side, const std::string& convex, const BliskAnatomy& anatomy,
                        const std::string& mesh_name) {
  if (side == "leading") return BladeRegion::leading_edge;
  if (side == "trailing") return BladeRegion::trailing_edge;
  const bool is_forward =
      (side == "convex") == (convexSide(convex, anatomy, mesh_name) == BladeSide::forward);
  return is_forward ? BladeRegion::forward : BladeRegion::backward;
}

std::optional<BladeSide> convexSideOf(const std::string& convex, const GrinderInput& input) {
  if (!convex.empty()) return convex == "forward" ? BladeSide::forward : BladeSide::backward;
  if (input.blades.count == 0) return std::nullopt;
  try {
    return findAnatomy(moved(input.blisk->mesh(), input.mesh_in_blisk), input.blades).convex_side;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

}  // namespace octoblisk::demos
