// The greatest length that the generators take.
#pragma once

namespace octoblisk::demos {

/// mm, of any coordinate or size: what is beyond is no blisk but a mistake in a file or on the command line.
inline constexpr double kMaxLength = 100'000.0;

}  // namespace octoblisk::demos
