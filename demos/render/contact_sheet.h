// Several frames of one sequence on a page.
#pragma once

#include <string>
#include <vector>

#include "render/picture.h"

namespace octoblisk::demos {

/// A frame: a picture whose only text is its caption; its legend entries go below the sheet.
struct SheetFrame {
  std::string caption;
  Picture picture;
};

/// The frames from left to right in rows of `columns` (≥ 1), each `frame_width` × `frame_height` pixels,
/// under a title and over one legend with the entries of all frames. The image is the same, bit for bit, for
/// any number of threads; 0 means one per processor. Throws std::invalid_argument if there is no frame, and
/// as render() does.
Image contactSheet(const std::vector<SheetFrame>& frames, const std::string& title,
                   const std::string& subtitle, int columns, int frame_width, int frame_height,
                   unsigned threads = 0);

}  // namespace octoblisk::demos
