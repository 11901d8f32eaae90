// How the tool stands at a contact on a blade.
#pragma once

#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// A point of a blade's surface, with the direction from root to tip there. Lengths in mm.
struct SurfacePoint {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitX();  ///< unit, out of the blade
  Vec3 to_tip = Vec3::UnitZ();  ///< unit, in the tangent plane
};

struct ToolPosture {
  double lead = 0.0;   ///< degrees, of the arm in the tangent plane, from `to_tip` about the normal
  double tilt = 0.0;   ///< degrees, of the arm off the tangent plane
  double slide = 0.0;  ///< mm, of the tool along the wheels' axis, so that another part of the belt grinds

  /// Whether passes run from root to tip: the belt grinds a line along the wheels' axis, and the passes cross
  /// it.
  bool grindsTowardsTip() const;

  /// The part of the belt's width that grinds on a flat or a bulging surface: a slid belt grinds to one side.
  double partOfBelt() const { return slide == 0.0 ? 1.0 : 0.5; }
};

/// Postures all around the normal, the steadiest first: those with the arm towards the tip, then those with
/// the arm flat on the surface, then those that grind with the middle of the belt.
std::vector<ToolPosture> posturesOf(double belt_width);

/// The pose belt_in_blisk (belt_grinder.h) in which a belt on a contact wheel of that radius touches the
/// point.
Pose poseAt(const SurfacePoint& at, const ToolPosture& posture, double wheel_radius);

}  // namespace octoblisk::demos
