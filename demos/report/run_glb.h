// Writes a replay as glTF 2.0, for Blender, ParaView and other viewers.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "report/replay.h"

namespace octoblisk::demos {

struct GlbOptions {
  double poses_per_second = 20.0;
  std::size_t contacts = 10'000;  ///< per verdict; if there are more, an evenly spaced subset is kept
};

/// A binary glTF file: a node for the blisk, with one primitive per blade and materials for hub, blades and
/// ground blade; a node "tool" with the parts, which one animation per track moves from pose to pose; and one
/// node per verdict with all contacts of the first track's poses, as octahedra 0.6 mm across. The root node
/// converts Z up to Y up and mm to metres, as glTF requires. Throws std::invalid_argument for a rate that is
/// not above 0.
std::string glbOf(const Replay& replay, const ReplayMeshes& meshes, const GlbOptions& options = {});

/// Writes that file. Throws std::runtime_error naming a file that cannot be written.
void writeGlb(const Replay& replay, const ReplayMeshes& meshes, const std::filesystem::path& file,
              const GlbOptions& options = {});

}  // namespace octoblisk::demos
