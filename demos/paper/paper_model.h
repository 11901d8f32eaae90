// The blisk or blade that the paper's experiments run on.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "models/blade_finder.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

using Points = std::vector<Vec3>;

/// Lengths in mm.
struct PaperModel {
  std::string name;
  std::shared_ptr<const TriangleMesh> mesh;   ///< the blisk, or a single blade
  BladesFound blades;                         ///< of the mesh; none for a single blade
  std::shared_ptr<const TriangleMesh> blade;  ///< the blisk's blade 1, or the whole mesh

  bool isBlisk() const { return blades.count > 0; }
};

/// A mesh in which blades are found is a blisk; any other mesh is a blade.
PaperModel paperModel(std::string name, TriangleMesh mesh);

/// Clouds of the blisk's parts: `count` points for each blade; for hub and shroud, which come last, as many
/// as their area requires, but at most four times as many. For a single blade, one cloud.
std::vector<Points> partClouds(const PaperModel& model, std::size_t count, std::uint64_t seed);

/// The built-in belt.
std::shared_ptr<const TriangleMesh> paperBelt();

}  // namespace octoblisk::demos
