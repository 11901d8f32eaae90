// Concave bodies that pile up, and the floor that they lie on. Closed forms, about 1 m across.
#pragma once

#include <vector>

#include "shared/meshes.h"

namespace octoblisk::testing {

/// What lies between two paths of as many points each, the outer one to the right of its direction, made as
/// thick as twice the half height along z. The ends of open paths are closed. Closed, outward.
SharedMesh extrudedBand(const std::vector<Eigen::Vector2d>& outer, const std::vector<Eigen::Vector2d>& inner,
                        bool is_ring, double half_height);

/// A spur gear with a bore, round the z axis.
SharedMesh gear(int teeth, double root_radius, double tip_radius, double bore_radius, double half_height);

/// A U of three walls, its opening towards y, along z.
SharedMesh uProfile(double half_width, double half_depth, double wall, double half_length);

/// A wavy floor whose rim rises, so that nothing rolls off: open, facing up.
double trayHeight(double x, double y);
SharedMesh tray(double half_size, int segments);

}  // namespace octoblisk::testing
