// Pictures of a grinding run pose by pose: the frames of a film, and a sheet with all of them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "grinding/grinding_run.h"
#include "io/whole_files.h"
#include "render/picture.h"

namespace octoblisk::demos {

/// `count` poses, evenly spaced from the first to the last, each once; all poses if there are fewer.
std::vector<std::size_t> posesOfFrames(std::size_t poses, std::size_t count);

/// Renders a picture to a PNG file.
using DrawPicture = std::function<void(const Picture& picture, const std::string& path)>;

/// Adds folder/frames/0000.png … and folder/contact_sheet.png to `files`: the blisk with the tool at each of
/// these poses, all from one camera, and a sheet with all frames. The folder must exist. Throws
/// std::runtime_error naming a file or folder that cannot be written.
void writeFrames(const GrindingRun& run, std::size_t count, const std::filesystem::path& folder,
                 WholeFiles& files, const DrawPicture& draw);

}  // namespace octoblisk::demos
