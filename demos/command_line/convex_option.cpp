#include "command_line/convex_option.h"

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "command_line/option_checks.h"

namespace octoblisk::demos {

void addConvexOption(CLI::App& command, std::string& convex) {
  command
      .add_option("--convex", convex,
                  "Convex side of the blades: forward, towards greater angles, or backward. Default: found "
                  "from the blades' camber")
      ->type_name("SIDE")
      ->check(oneOf({"forward", "backward"}));
}

BliskAnatomy anatomyOf(const TriangleMesh& blisk, const BliskFound& found, const std::string& mesh_name) {
  try {
    return findAnatomy(blisk, found.blades);
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
