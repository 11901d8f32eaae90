// The principal axes of a symmetric matrix.
#pragma once

#include "octoblisk/types.h"

namespace octoblisk::detail {

/// Columns by descending eigenvalue, each with a positive largest component, right-handed.
Mat3 principalAxes(const Mat3& symmetric);

}  // namespace octoblisk::detail
