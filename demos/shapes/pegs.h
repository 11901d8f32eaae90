// Pegs and the holes that they fit: closed meshes that face outward, around the z axis.
#pragma once

#include "shapes/bodies.h"

namespace octoblisk::shapes {

/// A prism in a bore with the same number of sides: 4 for a square peg with faces across the axes, many for a
/// round one.
struct PegInHole {
  int sides;
  double radius;     ///< of the peg, from the axis to its sides, m
  double clearance;  ///< between the sides of the peg and those of the bore, m
  double depth;      ///< of the bore, m
};

/// A peg from z = 0 to `length`. At its origin, it stands in a hole at the origin. Throws
/// std::invalid_argument if there are fewer than 3 sides, if the clearance is negative or if another length
/// is not positive.
SharedMesh peg(const PegInHole& fit, double length);

/// A block with a blind bore from z = 0 to the depth. Around the bore, and below it, the block is as thick as
/// the radius of the peg. Throws like `peg`.
SharedMesh hole(const PegInHole& fit);

}  // namespace octoblisk::shapes
