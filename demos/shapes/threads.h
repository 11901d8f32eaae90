// Bolts and nuts with metric threads: closed meshes that face outward, around the z axis.
#pragma once

#include "shapes/bodies.h"

namespace octoblisk::shapes {

/// A right-hand thread with the basic profile of ISO 68-1: flanks of 60°, a flat of P/8 at the crest of the
/// bolt and a flat of P/4 at its root.
struct Thread {
  double diameter;  ///< major diameter of the bolt, m
  double pitch;     ///< P, m
  double play;      ///< how much larger the nut's radius is everywhere than the bolt's, m
  int segments;     ///< around the axis; a multiple of 12
  int parts = 1;    ///< of each flank and each flat, along the axis
};

/// A coarse thread of a nominal diameter: M4, M5, M6, M8, M10, M12, M16 or M20 (ISO 261), with a play of
/// P/50. Throws std::invalid_argument for another size.
Thread coarseThread(int size, int segments = 96);

/// How far a nut can move along the axis without turning, m.
double axialPlay(const Thread& thread);

/// A threaded rod from z = 0 to `length`, on a round head below it. The head is as high as 0.6 diameters and
/// as wide as 1.6 diameters.
SharedMesh bolt(const Thread& thread, double length);

/// A hexagon nut from z = 0 to `height`, as wide across flats as 1.5 diameters. At its origin, it is in phase
/// with a bolt at the origin. So it is after a turn about z by an angle and a shift along z by the pitch
/// times angle / 2π.
SharedMesh nut(const Thread& thread, double height);

}  // namespace octoblisk::shapes
