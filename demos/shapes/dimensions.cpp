#include "shapes/dimensions.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace octoblisk::shapes {

void refuse(const char* part, const char* what, double value) {
  std::ostringstream message;
  message << part << " cannot have the " << what << ' ' << value;
  throw std::invalid_argument(message.str());
}

void requirePositive(const char* part, const char* what, double value) {
  if (!(value > 0.0 && std::isfinite(value))) refuse(part, what, value);
}

void requireNotNegative(const char* part, const char* what, double value) {
  if (!(value >= 0.0 && std::isfinite(value))) refuse(part, what, value);
}

}  // namespace octoblisk::shapes
