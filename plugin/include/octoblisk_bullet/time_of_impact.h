// When two moving concave bodies first come near each other within a step.
#pragma once

#include <LinearMath/btVector3.h>

#include <optional>

#include "octoblisk/sweep.h"
#include "octoblisk_bullet/triangle_parts.h"

class btCollisionObject;

namespace octoblisk {

class ClusteredOctreeShape;

/// Lengths are in world units, points in the world as the bodies are at the fraction.
struct StepImpact {
  btScalar fraction = 0;  ///< of the step: the bodies are proved apart before it
  btScalar distance = 0;  ///< margins taken off: at most 0 where the bodies touch at the start
  btVector3 point_on_a = btVector3(0, 0, 0);  ///< on A's surface, without its margin
  btVector3 point_on_b = btVector3(0, 0, 0);
  TriangleId triangle_a;
  TriangleId triangle_b;
  bool converged = true;  ///< as TimeOfImpact's
};

/// The fraction of a step of length `dt` (> 0) at which A and B first come as near as `tolerance`, margins
/// taken off; none where they stay farther apart. Both move as Bullet would move them by the velocities that
/// they have (step_motion.h), which is what the step does where no contact, force or constraint changes them.
/// Nothing, however thin, is passed through: octoblisk/sweep.h, of two moving bodies, has the proof. Nobody
/// needs to be in a world; nothing is changed.
///
/// The tolerance is raised to some units in the last place of the scene's size, and of the default, or any
/// below 0, is half the distance within which contacts of the two are created.
/// Throws std::invalid_argument where a body has another shape than ClusteredOctreeShape.
std::optional<StepImpact> timeOfImpact(const btCollisionObject& a, const btCollisionObject& b, btScalar dt,
                                       btScalar tolerance = -1, const SweepOptions& options = {});

/// The same for bodies of these shapes on any motions, in the core's terms: the tolerance given to the sweep,
/// in which the margins are.
double sweepTolerance(const ClusteredOctreeShape& a, const Motion& a_in_world, const ClusteredOctreeShape& b,
                      const Motion& b_in_world, btScalar tolerance = -1);

}  // namespace octoblisk
