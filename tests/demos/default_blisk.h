// The default blisk, made once.
#pragma once

#include "models/blisk.h"

namespace octoblisk::demos {

inline const Blisk& blisk() {
  static const Blisk result = makeDefaultBlisk();
  return result;
}

}  // namespace octoblisk::demos
