// What the options' values may be: checks with short messages of our own.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace octoblisk::demos {

/// A finite number from `least` to `greatest`; not `least` itself where `above` is set.
CLI::Validator numberFrom(double least, double greatest, bool above = false);

/// A whole number from `least` to `greatest`, in digits.
CLI::Validator wholeNumberFrom(std::int64_t least, std::int64_t greatest);

/// The name of a file or folder: not empty, as it becomes where a script's variable is not set.
CLI::Validator notEmpty();

}  // namespace octoblisk::demos
