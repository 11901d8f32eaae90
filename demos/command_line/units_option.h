// The option that names the length unit of a mesh file.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

inline constexpr const char* kUnitsHelp =
    "The length unit of the mesh: mm, m, in, or auto, which selects the unit by the mesh's size; default: "
    "mm. "
    "Results are in mm";

/// Adds `--units mm|m|in|auto`, or an option of another name. Without the option the text is empty, which
/// means mm.
void addUnitsOption(CLI::App& command, std::string& units, const std::string& help = kUnitsHelp,
                    const std::string& name = "--units");

/// The unit itself, or what "auto" selects for a size and reports on standard error: below 2.5 it is m, below
/// 80 in, otherwise mm.
std::string unitsFor(const std::string& units, double size, const std::filesystem::path& file);

/// The mesh in mm. "auto" goes by the diagonal of its bounding box.
TriangleMesh inMillimetres(TriangleMesh mesh, const std::string& units, const std::filesystem::path& file);

/// Throws std::runtime_error naming the file if a blisk of this size (the diagonal of its bounding box, mm)
/// is smaller than a tenth of a tool part of that size, or larger than `greatest_ratio` times it. The message
/// names the unit, and its factor, that would fit, and the option that says so: --units of the blisk,
/// `part_option` of the part.
void requireSizesFit(const std::string& blisk_file, double blisk_size, const std::string& part_name,
                     double part_size, double greatest_ratio, const std::string& part_option);

/// The diagonal of the mesh's bounding box.
double sizeOf(const TriangleMesh& mesh);

}  // namespace octoblisk::demos
