// The table and the picture of a coverage.
#pragma once

#include <filesystem>

#include "grinding/coverage.h"
#include "render/image.h"
#include "report/replay.h"

namespace octoblisk::demos {

/// coverage.csv: one row per cell of the grid; points are in the frame of the blisk's mesh. Throws
/// std::runtime_error if the file cannot be written.
void writeCoverage(const Coverage& coverage, const std::filesystem::path& file);

/// The blade's side, unrolled; each cell has the colour of the depth to which it is ground.
Image coveragePicture(const Coverage& coverage, int width = 1600, int height = 1200);

/// The same cells on the blade, in the frame of the blisk's mesh.
ReplaySide coverageOnBlade(const Coverage& coverage);

}  // namespace octoblisk::demos
