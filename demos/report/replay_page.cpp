#include "report/replay_page.h"

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/text_file.h"

// The page, made by report/web (./dev web), with a place for the run.
__asm__(
    ".pushsection .rodata\n"
    "octoblisk_replay_page_begin:\n"
    ".incbin \"" OCTOBLISK_REPLAY_PAGE
    "\"\n"
    "octoblisk_replay_page_end:\n"
    ".byte 0\n"
    ".popsection\n");
extern "C" const char octoblisk_replay_page_begin[], octoblisk_replay_page_end[];

namespace octoblisk::demos {
namespace {

constexpr std::string_view kPlaceOfRun = "@@RUN@@";

}  // namespace

void writeReplayPage(const Replay& replay, const ReplayMeshes& meshes, const std::filesystem::path& file,
                     const ReplayLimits& limits) {
  const std::string_view page(
      octoblisk_replay_page_begin,
      static_cast<std::size_t>(octoblisk_replay_page_end - octoblisk_replay_page_begin));
  const std::size_t place = page.find(kPlaceOfRun);
  if (place == std::string_view::npos) throw std::logic_error("the page has no place for the run");
  std::string text(page.substr(0, place));
  text += replayJson(replay, meshes, limits);
  text += page.substr(place + kPlaceOfRun.size());
  writeText(file, text);
}

}  // namespace octoblisk::demos
