// What the paper leaves open or gets wrong, and what is done here instead.
#pragma once

#include "render/document.h"

namespace octoblisk::demos {

/// All fourteen errata, numbered as everywhere in the report. What follows from the paper's own tables is
/// computed from them.
Section errataSection();

}  // namespace octoblisk::demos
