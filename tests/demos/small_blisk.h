// A blisk with blades 28 mm high, and a belt grinder that fits between them: plans take seconds.
#pragma once

#include <vector>

#include "models/belt_grinder.h"
#include "models/embedded_assets.h"

namespace octoblisk::demos {

inline TriangleMesh smallBlisk() {
  const TriangleMesh blisk = embeddedBlisk();
  std::vector<Vec3> vertices = blisk.vertices();
  for (Vec3& vertex : vertices) vertex *= 0.25;
  return {std::move(vertices), blisk.triangles()};
}

inline BeltParameters smallBelt() {
  return {.width = 3.0,
          .thickness = 0.5,
          .contact_wheel_radius = 1.0,
          .drive_wheel_radius = 4.0,
          .wheel_distance = 60.0,
          .wheel_gap = 0.02};
}

}  // namespace octoblisk::demos
