// What made a report.
#pragma once

#include "render/document.h"

namespace octoblisk::demos {

/// octoblisk and the libraries that its answers rest on, a row each.
Table versionsTable();

}  // namespace octoblisk::demos
