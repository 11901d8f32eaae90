#include "models/embedded_assets.h"

#include "io/embedded_file.h"
#include "io/mesh_file.h"

OCTOBLISK_EMBED(octoblisk_blisk, OCTOBLISK_ASSETS "/blisk.ply");
OCTOBLISK_EMBED(octoblisk_belt, OCTOBLISK_ASSETS "/belt.ply");
OCTOBLISK_EMBED(octoblisk_contact_wheel, OCTOBLISK_ASSETS "/contact_wheel.ply");
OCTOBLISK_EMBED(octoblisk_drive_wheel, OCTOBLISK_ASSETS "/drive_wheel.ply");
OCTOBLISK_EMBED(octoblisk_arm, OCTOBLISK_ASSETS "/arm.ply");

namespace octoblisk::demos {

TriangleMesh embeddedBlisk() { return readMesh("blisk.ply", OCTOBLISK_EMBEDDED(octoblisk_blisk)); }

std::vector<EmbeddedPart> embeddedBeltGrinder() {
  return {{"belt", readMesh("belt.ply", OCTOBLISK_EMBEDDED(octoblisk_belt))},
          {"contact wheel", readMesh("contact_wheel.ply", OCTOBLISK_EMBEDDED(octoblisk_contact_wheel))},
          {"drive wheel", readMesh("drive_wheel.ply", OCTOBLISK_EMBEDDED(octoblisk_drive_wheel))},
          {"arm", readMesh("arm.ply", OCTOBLISK_EMBEDDED(octoblisk_arm))}};
}

}  // namespace octoblisk::demos
