// The time of impact of two bodies in motion.
#pragma once

#include <optional>

#include "octoblisk/convex.h"
#include "octoblisk/distance.h"
#include "octoblisk/motion.h"

namespace octoblisk {

struct SweepOptions {
  /// The distance at the impact may exceed the tolerance by this fraction of the tolerance, > 0. A smaller
  /// slack takes more steps.
  double slack = 0.125;
  /// The greatest number of distances to compute.
  int max_steps = 1000;
  /// Ignores impacts at this fraction or later; > 0, at most 1. A smaller value makes the search shorter.
  double until = 1.0;
};

struct TimeOfImpact {
  double fraction = 0.0;  ///< of the motion: the bodies are proved apart before it
  Clearance clearance;    ///< at this fraction
  /// False if the search used up its steps: then nothing is known beyond the fraction, and the clearance is
  /// above the tolerance.
  bool converged = true;
};

/// The fraction of B's motion at which the surfaces of A and B first come within `tolerance`, > 0, mesh
/// units; none if they stay farther apart. Misses no contact, however thin A and B are: a step moves no point
/// of B by more than the current distance less the tolerance (conservative advancement: B. Mirtich,
/// Impulse-based Dynamic Simulation of Rigid Body Systems, 1996).
///
/// Before the fraction, the distance is proved to exceed the tolerance. At the fraction, it is at most
/// (1 + slack) · tolerance. If the bodies touch at the start, fraction and distance are 0. The tolerance is
/// raised by 1e-12 of the scene's size to allow for the rounding of poses and distances.
///
/// Computes at most `max_steps` distances, and at most lengthBound / (slack · tolerance) + 1. The bound on
/// the speed ignores its direction, so sliding along A just above the tolerance takes the most steps: a path
/// of a thousand times the clearance takes about a thousand. A free path shorter than the clearance takes
/// one. Allocates nothing.
std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const ClusteredOctree& b, const Motion& b_in_a,
                                  double tolerance, const SweepOptions& options = {});

/// The same for two bodies that move at the same time. Their relative motion is no screw, so the steps use
/// relativeLengthBound (motion.h) instead of lengthBound. The clearance is in A's frame at the fraction.
std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const ClusteredOctree& b,
                                  const Motion& a_in_world, const Motion& b_in_world, double tolerance,
                                  const SweepOptions& options = {});

/// The same two functions for the surface of A and a convex body B. B is solid: whatever is inside it touches
/// it. The tolerance is also raised by twice the error of B's support points.
std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const Convex& b, const Motion& b_in_a,
                                  double tolerance, const SweepOptions& options = {});
std::optional<TimeOfImpact> sweep(const ClusteredOctree& a, const Convex& b, const Motion& a_in_world,
                                  const Motion& b_in_world, double tolerance,
                                  const SweepOptions& options = {});

}  // namespace octoblisk
