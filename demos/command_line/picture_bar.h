// Renders slow pictures with a progress bar.
#pragma once

#include <string>

#include "render/picture.h"

namespace octoblisk::demos {

/// Renders the page to a PNG file and shows the progress. Throws as writePng (picture.h).
void writePngWatched(const Picture& picture, const std::string& path);

}  // namespace octoblisk::demos
