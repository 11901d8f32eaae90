// Runs the scenes of the gallery and writes their pictures and numbers.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "gallery/gallery_scene.h"

namespace octoblisk::gallery {

/// All scenes, in the order of docs/gallery.md.
const std::vector<Exhibit>& exhibits();

/// Runs the scene to its end. Writes its frames on a contact sheet, NAME.png, and its numbers at about forty
/// points in time, NAME.csv. `tree` has the build options of all shapes. Returns the numbers at the end.
/// Throws std::runtime_error naming a file that cannot be written.
std::vector<Number> show(const Exhibit& exhibit, const std::filesystem::path& folder,
                         const BuildOptions& tree = {});

}  // namespace octoblisk::gallery
