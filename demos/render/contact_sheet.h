// Several frames of one course of events on a page.
#pragma once

#include <string>
#include <vector>

#include "render/picture.h"

namespace octoblisk::demos {

/// A frame: a picture whose only words are its caption and, below the sheet, what is in its legend.
struct SheetFrame {
  std::string caption;
  Picture picture;
};

/// The frames from left to right in rows of `columns` (≥ 1), each `frame_width` × `frame_height` pixels,
/// under a title and over one legend, of all that is in theirs. The same, bit for bit, for any number of
/// threads; 0 stands for one a processor. Throws std::invalid_argument where there is no frame, and as
/// render() does.
Image contactSheet(const std::vector<SheetFrame>& frames, const std::string& title,
                   const std::string& subtitle, int columns, int frame_width, int frame_height,
                   unsigned threads = 0);

}  // namespace octoblisk::demos
