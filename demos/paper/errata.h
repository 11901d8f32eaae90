// Errors and gaps of the paper, and the solutions here.
#pragma once

#include "render/document.h"

namespace octoblisk::demos {

/// All fourteen errata, with the numbers used throughout the report. Numbers that follow from the paper's own
/// tables are computed from them.
Section errataSection();

}  // namespace octoblisk::demos
