// Spline shafts and the hubs that they turn: closed meshes that face outward, around the z axis.
#pragma once

#include "shapes/bodies.h"

namespace octoblisk::shapes {

/// Teeth with parallel sides. Their tips and the ground between them are flat. The bore of the hub is the
/// section of the shaft, larger by the clearance everywhere. Lengths are in m.
struct Spline {
  int teeth;         ///< the middle of the first is on the x axis
  double root;       ///< from the axis to the ground between the teeth of the shaft
  double tip;        ///< from the axis to the tips
  double width;      ///< of the shaft's teeth
  double clearance;  ///< between the faces of the shaft and those of the hub
};

/// A shaft from z = 0 to `length`. Throws std::invalid_argument if there are fewer than 3 teeth, if the
/// clearance is negative, if another length is not positive, or if the teeth do not leave the ground between
/// them free and stand out of it.
SharedMesh splineShaft(const Spline& spline, double length);

/// A hub from z = 0 to `length`, at its origin around a shaft at the origin. It is twice as wide as its bore.
/// Throws like `splineShaft`.
SharedMesh splineHub(const Spline& spline, double length);

}  // namespace octoblisk::shapes
