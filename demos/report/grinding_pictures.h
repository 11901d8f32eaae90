// The pictures of a grinding run, and the frames of a film of it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "grinding/grinding_run.h"
#include "io/whole_files.h"
#include "render/picture.h"
#include "report/grinding_report.h"

namespace octoblisk::demos {

/// The most interesting pose: that of the deepest unintended touch; without one, that of the deepest touch;
/// without any, the middle of the path.
std::size_t poseToShow(const GrindingRun& run);

/// The worst touch of a pose that has a touch: "belt on blade 2, 0.31 mm deep", "arm on hub or shroud, …",
/// "belt wholly inside the blisk, …".
std::string describeWorst(const GrindingRun& run, const PoseReport& pose);

/// The blisk with the ground blade, the path, and the tool at a pose.
Picture overviewOf(const GrindingRun& run, std::size_t pose);

/// The same at the pose to show.
Picture overviewOf(const GrindingRun& run);

/// The place where the tool touches, or comes nearest, at the pose to show, with the boxes of the blisk's
/// tree there.
Picture closeupOf(const GrindingRun& run);

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
