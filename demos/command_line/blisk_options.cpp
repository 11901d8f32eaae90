#include "command_line/blisk_options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "command_line/option_checks.h"
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
  command
      .add_option("--blisk", blisk, "Mesh file of the blisk, in any position. Default: the built-in blisk")
      ->type_name("FILE")
      ->check(notEmpty());
  command
      .add_option("--axis", axis,
                  "Axis of the blisk, x,y,z[,px,py,pz]: the direction from leading to trailing edge, and a "
                  "point on the axis (0,0,0 if not given), in the mesh's frame. Default: found from the mesh")
      ->type_name("AXIS")
      ->check(notEmpty());
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

}  // namespace octoblisk::demos
