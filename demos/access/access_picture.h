// The picture of an accessibility map.
#pragma once

#include <span>

#include "access/access_table.h"
#include "render/image.h"

namespace octoblisk::demos {

/// The blade's side, unrolled to height over arc length; each point's cell has the colour of its widest free
/// range of tilt. Points without an arc length are left out.
Image accessPicture(std::span<const AccessRow> rows, const AccessQuestion& question, int width = 1600,
                    int height = 1200);

}  // namespace octoblisk::demos
