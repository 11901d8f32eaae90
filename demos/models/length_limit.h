// The greatest length that the generators accept.
#pragma once

namespace octoblisk::demos {

/// mm, for any coordinate or size: a larger value is a mistake in a file or on the command line.
inline constexpr double kMaxLength = 100'000.0;

}  // namespace octoblisk::demos
