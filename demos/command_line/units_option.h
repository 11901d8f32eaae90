// The option --units, the length unit of a mesh file.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

inline constexpr const char* kUnitsHelp =
    "Length unit of the mesh: mm, m, in, or auto, which selects the unit by the mesh's size. Default: mm. "
    "Results are in mm";

/// Adds `--units mm|m|in|auto`, or the same under another name. If the option is not given the text is empty,
/// which means mm.
void addUnitsOption(CLI::App& command, std::string& units, const std::string& help = kUnitsHelp,
                    const std::string& name = "--units");

/// The unit itself. "auto" selects by size and reports its choice on standard error: m below 2.5, in below
/// 80, otherwise mm.
std::string unitsFor(const std::string& units, double size, const std::filesystem::path& file);

/// The mesh in mm. "auto" selects the unit by the diagonal of the bounding box.
TriangleMesh inMillimetres(TriangleMesh mesh, const std::string& units, const std::filesystem::path& file);

/// Throws std::runtime_error naming the file if a blisk of this size (the diagonal of its bounding box, mm)
/// is smaller than a tenth of a tool part of that size, or larger than `greatest_ratio` times it. The message
/// names the unit that would fit, its factor, and the option that sets it: --units for the blisk,
/// `part_option` for the part.
void requireSizesFit(const std::string& blisk_file, double blisk_size, const std::string& part_name,
                     double part_size, double greatest_ratio, const std::string& part_option);

/// The diagonal of the mesh's bounding box.
double sizeOf(const TriangleMesh& mesh);

}  // namespace octoblisk::demos
