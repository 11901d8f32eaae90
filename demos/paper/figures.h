// Figures 2, 4, 5, 7 and 8 of the paper, for our belt and blade.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "paper/paper_model.h"
#include "paper/progress.h"
#include "render/picture.h"

namespace octoblisk::demos {

struct NamedPicture {
  std::string file;
  std::string caption;
  Picture picture;
};

/// Figure 2: the belt's points in their box along the principal axes.
NamedPicture beltBoxPicture(const TriangleMesh& belt);

/// Figure 4: the blade's traditional cells at FNOP 2, 10 and 50, cubes along the axes.
std::vector<NamedPicture> cellPictures(const PaperModel& model, const Points& cloud);

/// Figure 5: traditional beside improved with k = 2, along the axes and in principal frames, at FNOP 10.
std::vector<NamedPicture> comparisonPictures(const PaperModel& model, const Points& cloud,
                                             std::uint64_t seed);

/// Figure 8: the blade's clusters for k = 2..8.
std::vector<NamedPicture> clusterPictures(const PaperModel& model, const Points& cloud, std::uint64_t seed);

/// Draws all of them, and figure 7, into the folder. The result has the files and captions of each of the
/// four figures. Throws as writePng and writeSvg.
nlohmann::json drawFigures(const PaperModel& model, const TriangleMesh& belt, const Points& cloud,
                           std::uint64_t seed, const std::filesystem::path& folder, const Progress& progress);

}  // namespace octoblisk::demos
