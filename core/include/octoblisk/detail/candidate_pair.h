// A pair of triangles that may meet, before the exact test.
#pragma once

#include "octoblisk/contact.h"

namespace octoblisk::detail {

/// Two triangles that the filter does not part.
struct CandidatePair {
  TrianglePair triangles;
  bool meets;  ///< for certain; else the exact test has to say
};

}  // namespace octoblisk::detail
