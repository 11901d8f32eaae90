// Reads any bytes as a hub's profile followed by the sections of a blade. They are refused with a one-line
// message, or give a blade with finite points.
#include "fuzz/fuzz_input.h"
#include "models/blade_sections.h"
#include "models/blade_surface.h"
#include "models/radius_profile.h"

using namespace octoblisk;
using namespace octoblisk::demos;

namespace {

void requireFinite(const BladeGrid& grid) {
  for (const BladeSide side : {BladeSide::forward, BladeSide::backward}) {
    for (int row = 0; row <= grid.spanCells(); ++row) {
      for (int station = 0; station <= grid.chordCells(); ++station) {
        if (!toCartesian(grid.at(side, row, station)).allFinite()) fuzz::fail("a point that is not finite");
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMaxSections = 6;
  static const fuzz::ScratchFolder folder;
  const std::vector<std::string_view> pieces = fuzz::pieces(fuzz::textOf(data, size));
  const std::filesystem::path hub_file = folder.write("hub.csv", pieces.front());
  const std::filesystem::path sections_folder = folder.path() / "sections";
  std::filesystem::create_directory(sections_folder);
  for (std::size_t k = 1; k <= kMaxSections; ++k) {
    const std::string name = "sections/section_" + std::to_string(k) + ".csv";
    if (k < pieces.size()) {
      folder.write(name, pieces[k]);
    } else {
      std::filesystem::remove(folder.path() / name);
    }
  }
  RadiusProfile hub = cylinderProfile(10, 100);
  BladeSections sections;
  try {
    hub = readHubProfile(hub_file);
  } catch (const std::runtime_error& refusal) {
    fuzz::requireClear(refusal, hub_file);
  }
  try {
    sections = readBladeSections(sections_folder);
  } catch (const std::runtime_error& refusal) {
    fuzz::requireClear(refusal, sections_folder);
    return 0;
  }
  try {
    requireFinite(sampleBlade(sections, hub, nullptr, 8, 4));
  } catch (const std::invalid_argument&) {  // valid sections that give no blade
  }
  return 0;
}
