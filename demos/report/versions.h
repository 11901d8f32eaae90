// The versions of the software that made a report.
#pragma once

#include "render/document.h"

namespace octoblisk::demos {

/// octoblisk and the libraries that its answers depend on, one row each.
Table versionsTable();

}  // namespace octoblisk::demos
