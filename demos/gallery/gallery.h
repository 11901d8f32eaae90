// The gallery: scenes run, their pictures and numbers written.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "gallery/gallery_scene.h"

namespace octoblisk::gallery {

/// All that there is to see, in the order in which docs/gallery.md shows it.
const std::vector<Exhibit>& exhibits();

/// Runs the scene to its end and writes NAME.png, its frames on a contact sheet, and NAME.csv, the time and
/// its numbers at some forty times. `tree` is of all shapes. Returns the numbers at the end. Throws
/// std::runtime_error naming a file that cannot be written.
std::vector<Number> show(const Exhibit& exhibit, const std::filesystem::path& folder,
                         const BuildOptions& tree = {});

}  // namespace octoblisk::gallery
