// The default models, embedded in the program from the files of assets/.
#pragma once

#include <string>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// The default blisk of 50,112 triangles (makeDefaultBlisk), mm.
TriangleMesh embeddedBlisk();

struct EmbeddedPart {
  std::string name;
  TriangleMesh mesh;
};

/// The default belt grinder: belt, contact wheel, drive wheel, arm (belt_grinder.h), in mm; the belt comes
/// first.
std::vector<EmbeddedPart> embeddedBeltGrinder();

}  // namespace octoblisk::demos
