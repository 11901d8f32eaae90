// The default models, built into the program: the checked-in files of assets/.
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

/// The default belt grinder: belt, contact wheel, drive wheel, arm (belt_grinder.h), mm; the belt first.
std::vector<EmbeddedPart> embeddedBeltGrinder();

}  // namespace octoblisk::demos
