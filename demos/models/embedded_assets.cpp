#include "models/embedded_assets.h"

#include <string_view>

#include "io/mesh_file.h"

// Puts a file of assets/ into the program, between two symbols.
#define OCTOBLISK_EMBED(symbol, file)                           \
  __asm__(".pushsection .rodata\n" #symbol                      \
          "_begin:\n"                                           \
          ".incbin \"" OCTOBLISK_ASSETS "/" file "\"\n" #symbol \
          "_end:\n"                                             \
          ".byte 0\n"                                           \
          ".popsection\n");                                     \
  extern "C" const char symbol##_begin[], symbol##_end[]

OCTOBLISK_EMBED(octoblisk_blisk, "blisk.ply");
OCTOBLISK_EMBED(octoblisk_belt, "belt.ply");
OCTOBLISK_EMBED(octoblisk_contact_wheel, "contact_wheel.ply");
OCTOBLISK_EMBED(octoblisk_drive_wheel, "drive_wheel.ply");
OCTOBLISK_EMBED(octoblisk_arm, "arm.ply");

namespace octoblisk::demos {
namespace {

TriangleMesh embedded(const char* name, const char* begin, const char* end) {
  return readMesh(name, std::string_view(begin, static_cast<std::size_t>(end - begin)));
}

}  // namespace

TriangleMesh embeddedBlisk() { return embedded("blisk.ply", octoblisk_blisk_begin, octoblisk_blisk_end); }

std::vector<EmbeddedPart> embeddedBeltGrinder() {
  return {
      {"belt", embedded("belt.ply", octoblisk_belt_begin, octoblisk_belt_end)},
      {"contact wheel",
       embedded("contact_wheel.ply", octoblisk_contact_wheel_begin, octoblisk_contact_wheel_end)},
      {"drive wheel", embedded("drive_wheel.ply", octoblisk_drive_wheel_begin, octoblisk_drive_wheel_end)},
      {"arm", embedded("arm.ply", octoblisk_arm_begin, octoblisk_arm_end)}};
}

}  // namespace octoblisk::demos
