// Checks of option values, with short messages.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace octoblisk::demos {

/// A finite number from `least` to `greatest`; excludes `least` itself if `above` is set.
CLI::Validator numberFrom(double least, double greatest, bool above = false);

/// A whole number from `least` to `greatest`, in digits.
CLI::Validator wholeNumberFrom(std::int64_t least, std::int64_t greatest);

/// One of the values, which the help lists.
CLI::Validator oneOf(const std::vector<std::string>& values);

/// The name of a file or folder. An unset variable in a script often makes it empty.
CLI::Validator notEmpty();

}  // namespace octoblisk::demos
