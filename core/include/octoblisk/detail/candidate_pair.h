// A pair of triangles that may meet, before the exact test.
#pragma once

#include "octoblisk/contact.h"

namespace octoblisk::detail {

/// Two triangles that the filter could not separate.
struct CandidatePair {
  TrianglePair triangles;
  bool meets;  ///< certainly; otherwise the exact test decides
};

}  // namespace octoblisk::detail
