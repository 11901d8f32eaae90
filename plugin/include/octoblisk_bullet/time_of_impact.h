// When two moving bodies, one of our shape, first come near each other within a step.
#pragma once

#include <LinearMath/btVector3.h>

#include <optional>

#include "octoblisk/sweep.h"
#include "octoblisk_bullet/triangle_parts.h"

class btCollisionObject;
class btCollisionShape;

namespace octoblisk {

/// Lengths are in world units, points in the world as the bodies are at the fraction.
struct StepImpact {
  btScalar fraction = 0;  ///< of the step: the bodies are proved apart before it
  btScalar distance = 0;  ///< margins taken off: at most 0 where the bodies touch at the start
  btVector3 point_on_a = btVector3(0, 0, 0);  ///< on A's surface: without its margin, if it is of triangles
  btVector3 point_on_b = btVector3(0, 0, 0);
  TriangleId triangle_a;  ///< {-1, -1}: the part is convex
  TriangleId triangle_b;
  const btCollisionShape* part_a = nullptr;  ///< A's shape, or the child of its compound
  const btCollisionShape* part_b = nullptr;
  bool converged = true;  ///< as TimeOfImpact's
};

/// The fraction of a step of length `dt` (> 0) at which A and B first come as near as `tolerance`, margins
/// taken off; none where they stay farther apart. Both move as Bullet would move them by the velocities that
/// they have (step_motion.h), which is what the step does where no contact, force or constraint changes them.
/// Nothing, however thin, is passed through: octoblisk/sweep.h, of two moving bodies, has the proof. Nobody
/// needs to be in a world; nothing is changed.
///
/// The parts of a body are its shape, or the children of its compound, that are ClusteredOctreeShape or
/// convex. Every part of A is compared with every part of B, except two convex parts. Parts of other shapes
/// are not seen.
///
/// The tolerance is raised to some units in the last place of the scene's size, and of the default, or any
/// below 0, is half the distance within which contacts of the two parts are created.
/// Throws std::invalid_argument where there are no two parts to compare.
std::optional<StepImpact> timeOfImpact(const btCollisionObject& a, const btCollisionObject& b, btScalar dt,
                                       btScalar tolerance = -1, const SweepOptions& options = {});

}  // namespace octoblisk
