// The gallery's pile of concave bodies, for tests and benchmarks.
#pragma once

#include "gallery/concave_pile.h"
#include "plugin/bullet_world.h"
#include "shared/meshes.h"

namespace octoblisk::testing {

using gallery::ConcavePile;
using gallery::makeOurShape;

}  // namespace octoblisk::testing
