// The option that names the length unit of a mesh file.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// Adds `--units mm|m|in|auto`. Without the option the text is empty, which means mm.
void addUnitsOption(CLI::App& command, std::string& units);

/// The mesh in mm. "auto" selects the unit by the diagonal of the bounding box and reports it on standard
/// error: below 2.5 it is m, below 80 in, otherwise mm.
TriangleMesh inMillimetres(TriangleMesh mesh, const std::string& units, const std::filesystem::path& file);

/// Throws std::runtime_error naming the file if a blisk of this size (the diagonal of its bounding box, mm)
/// cannot belong to a tool part of that size. The message names the unit, and its factor, that would fit.
void requireSizesFit(const std::string& blisk_file, double blisk_size, const std::string& part_name,
                     double part_size);

/// The diagonal of the mesh's bounding box.
double sizeOf(const TriangleMesh& mesh);

}  // namespace octoblisk::demos
