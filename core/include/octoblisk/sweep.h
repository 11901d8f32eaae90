// When a moving body first comes near another.
#pragma once

#include <optional>

#include "octoblisk/convex.h"
#include "octoblisk/distance.h"
#include "octoblisk/motion.h"

namespace octoblisk {

struct SweepOptions {
  /// How far above the tolerance the distance may still be where an impact is told, as a part of the
  /// tolerance, > 0: the smaller, the more steps.
  double slack = 0.125;
  /// Distances measured at most.
  int max_steps = 1000;
  /// Impacts at this fraction or later are left out; > 0, at most 1. The earlier it is, the less is searched.
  double until = 1.0;
};

struct TimeOfImpact {
  double fraction = 0.0;  ///< of the motion: the bodies are proved apart before it
  Clearance clearance;    ///< at this fraction
  /// False where the steps were used up: nothing is known of what follows the fraction, and the clearance
  /// is above the tolerance.
  bool converged = true;

  TrianglePair pair() const { return {clearance.triangle_a, clearance.triangle_b}; }
};

/// The fraction of B's motion at which the surfaces of A and B first come as near as `tolerance`, > 0, mesh
/// units; none where they stay farther apart all the way. Continuous: nothing, however thin, is passed
/// through, as a step never exceeds the distance less the tolerance over the bound on the speed of any point
/// of B (conservative advancement: B. Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996).
///
/// Before the fraction the distance is proved to be above the tolerance; at it, it is at most
/// (1 + slack) · tolerance, or 0 where the bodies touch at the start, which gives fraction 0. For the
/// rounding of poses and distances the tolerance is raised by 1e-12 of the scene's size.
///
/// Ends after at most `max_steps` distances, and after lengthBound / (slack · tolerance) + 1 anyway. The
/// bound on the speed knows no direction, so that sliding along A just above the tolerance takes most: a way
/// of a thousand times the clearance, about as many. A free way of less than the clearance takes one.
/// Allocates nothing.
std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const ClusteredOctree& b, const Motion& b_in_a,
                                  double tolerance, const SweepOptions& options = {});

/// The same for two bodies that move at once over the same fractions: two screws to each other are no screw,
/// so the steps go by relativeLengthBound (motion.h), which takes lengthBound's place in all that is said
/// above. The clearance is in A's frame at the fraction.
std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const ClusteredOctree& b,
                                  const Motion& a_in_world, const Motion& b_in_world, double tolerance,
                                  const SweepOptions& options = {});

/// The same two functions for the surface of A and a convex body B. B is solid: what is inside it touches it.
/// The tolerance is raised by twice the error of B's support points as well.
std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const Convex& b, const Motion& b_in_a,
                                  double tolerance, const SweepOptions& options = {});
std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const Convex& b, const Motion& a_in_world,
                                  const Motion& b_in_world, double tolerance,
                                  const SweepOptions& options = {});

}  // namespace octoblisk
