#include "command_line/picture_bar.h"

#include <iostream>
#include <optional>

#include "io/progress_bar.h"

namespace octoblisk::demos {

void writePngWatched(const Picture& picture, const std::string& path) {
  std::optional<ProgressBar> bar;
  const Image page = render(picture, kPageWidth, kPageHeight, 0, [&](std::size_t done, std::size_t bands) {
    if (!bar) bar.emplace(std::cerr, bands);
    bar->update(done);
  });
  writePng(page, path);
}

}  // namespace octoblisk::demos
