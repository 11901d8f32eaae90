// Pictures that take a while, with a bar for people.
#pragma once

#include <string>

#include "render/picture.h"

namespace octoblisk::demos {

/// Renders the page to a PNG file, and shows how far it is. Throws as writePng (picture.h).
void writePngWatched(const Picture& picture, const std::string& path);

}  // namespace octoblisk::demos
