// Dimensions that a part cannot have.
#pragma once

namespace octoblisk::shapes {

/// Throws std::invalid_argument that names the part, what it cannot have, and the value.
[[noreturn]] void refuse(const char* part, const char* what, double value);

/// Throw like `refuse` unless the value is finite and positive, or not negative.
void requirePositive(const char* part, const char* what, double value);
void requireNotNegative(const char* part, const char* what, double value);

}  // namespace octoblisk::shapes
