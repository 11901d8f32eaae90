#include "command_line/units_option.h"

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "command_line/options.h"
#include "command_line/print_message.h"
#include "io/number_text.h"

namespace octoblisk::demos {
namespace {

struct LengthUnit {
  const char* name;
  double millimetres;
};
constexpr LengthUnit kMillimetre = {"mm", 1.0}, kMetre = {"m", 1000.0}, kInch = {"in", 25.4};

LengthUnit unitBySize(double size) {
  constexpr double kLargestInMetres = 2.5, kLargestInInches = 80.0;
  if (size < kLargestInMetres) return kMetre;
  return size < kLargestInInches ? kInch : kMillimetre;
}

LengthUnit unitOf(const std::string& units) {
  if (units == kMetre.name) return kMetre;
  return units == kInch.name ? kInch : kMillimetre;
}

}  // namespace

void addUnitsOption(CLI::App& command, std::string& units, const std::string& help, const std::string& name) {
  addChoice(command, name, units, {"mm", "m", "in", "auto"}, help);
}

std::string unitsFor(const std::string& units, double size, const std::filesystem::path& file) {
  if (units != "auto") return units;
  const LengthUnit unit = unitBySize(size);
  printMessage("note: " + file.string() + ": read in " + unit.name +
               ", because its bounding box has a diagonal of " + shortText(size));
  return unit.name;
}

TriangleMesh inMillimetres(TriangleMesh mesh, const std::string& units, const std::filesystem::path& file) {
  const LengthUnit unit = unitOf(unitsFor(units, sizeOf(mesh), file));
  if (unit.millimetres == 1.0) return mesh;
  std::vector<Vec3> vertices = mesh.vertices();
  for (Vec3& vertex : vertices) vertex *= unit.millimetres;
  return {std::move(vertices), mesh.triangles()};
}

void requireSizesFit(const std::string& blisk_file, double blisk_size, const std::string& part_name,
                     double part_size, double greatest_ratio, const std::string& part_option) {
  constexpr double kMinRatio = 0.1;
  const double ratio = blisk_size / part_size;
  if (ratio >= kMinRatio && ratio <= greatest_ratio) return;
  const bool is_blisk_small = ratio < kMinRatio;
  const LengthUnit unit = unitBySize(is_blisk_small ? blisk_size : part_size);
  const std::string sizes = blisk_file + ": the blisk is " + shortText(blisk_size) + " mm across, the " +
                            part_name + " is " + shortText(part_size) +
                            " mm: one of them probably has another unit. ";
  if (unit.millimetres == 1.0) {
    throw std::runtime_error(sizes + "Correct --units or " + part_option +
                             "; --units mm accepts the sizes as they are");
  }
  const std::string factor = " (a factor of " + shortText(unit.millimetres) + ")";
  throw std::runtime_error(sizes +
                           (is_blisk_small
                                ? std::string("--units ") + unit.name + factor + " would make the blisk " +
                                      shortText(blisk_size * unit.millimetres) + " mm"
                                : part_option + " " + unit.name + factor + " would make the " + part_name +
                                      " " + shortText(part_size * unit.millimetres) + " mm") +
                           "; --units mm accepts the sizes as they are");
}

double sizeOf(const TriangleMesh& mesh) { return 2.0 * mesh.bounds().halfExtents().norm(); }

}  // namespace octoblisk::demos
