// When two moving bodies, one of our shape, first come near each other within a step.
#pragma once

#include <LinearMath/btVector3.h>

#include <optional>

#include "octoblisk/sweep.h"
#include "octoblisk_bullet/triangle_parts.h"

class btCollisionObject;
class btCollisionShape;

namespace octoblisk {

/// Lengths are in world units. Points are in the world, with the bodies at the fraction.
struct StepImpact {
  btScalar fraction = 0;                      ///< of the step: the bodies are proved apart before it
  btScalar distance = 0;                      ///< between the margins; at most 0: they touch at the start
  btVector3 point_on_a = btVector3(0, 0, 0);  ///< on A's surface; of a mesh: on a triangle, not its margin
  btVector3 point_on_b = btVector3(0, 0, 0);
  TriangleId triangle_a;  ///< {-1, -1}: the part is convex
  TriangleId triangle_b;
  const btCollisionShape* part_a = nullptr;  ///< A's shape, or the child of its compound
  const btCollisionShape* part_b = nullptr;
  bool converged = true;  ///< as TimeOfImpact's
};

/// The fraction of a step of length `dt` (> 0) at which A and B first come within `tolerance`, after
/// subtracting their margins; none if they stay farther apart. Both move as Bullet would move them by their
/// current velocities (step_motion.h). A step moves them in the same way unless a contact, force or
/// constraint changes the velocities. The function misses no contact, however thin a body is:
/// octoblisk/sweep.h explains the proof. The bodies need not be in a world, and nothing changes.
///
/// The parts of a body are its shape, or the children of its compound, if they are ClusteredOctreeShape or
/// convex. Every part of A is compared with every part of B, except two convex parts. Parts of other shapes
/// are ignored.
///
/// At the fraction, the distance is at most (1 + options.slack) · tolerance, after subtracting the margins.
/// A tolerance from 0 to a few units in the last place of the scene's size is raised to that length. A value
/// below 0 selects the default: half the distance within which a step creates contacts of the two parts.
/// Throws std::invalid_argument if a body has no shape, or if no two parts can be compared.
std::optional<StepImpact> timeOfImpact(const btCollisionObject& a, const btCollisionObject& b, btScalar dt,
                                       btScalar tolerance = -1, const SweepOptions& options = {});

}  // namespace octoblisk
