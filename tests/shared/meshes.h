// Meshes and random poses for tests and benchmarks. All seeded, all closed forms.
#pragma once

#include <memory>
#include <random>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::testing {

/// A uniform number in [low, high): the same on every platform.
double uniform(std::mt19937_64& random, double low, double high);

Vec3 randomPoint(std::mt19937_64& random, double half_size);
Mat3 randomRotation(std::mt19937_64& random);

/// A uniform rotation, and a translation of each coordinate within ±half_size.
Pose randomPose(std::mt19937_64& random, double half_size);

/// A triangle with corners within ±half_size.
Triangle randomTriangle(std::mt19937_64& random, double half_size);

using SharedMesh = std::shared_ptr<const TriangleMesh>;

/// A torus round the z axis: closed, outward.
SharedMesh torus(double major_radius, double minor_radius, int major_segments, int minor_segments);

/// A box with its 12 triangles, closed, outward.
SharedMesh boxMesh(const Vec3& half_extents);

/// z = height · sin(x) · cos(y) over ±half_size, open, facing up.
SharedMesh waveSheet(double half_size, double height, int segments);

/// Thin twisted blades round the z axis, not joined: what a blisk is like to a tree.
SharedMesh fan(int blades, int segments);

/// Random triangles, each of about the given size, within ±half_size; every eighth is degenerate or a
/// duplicate.
SharedMesh soup(std::mt19937_64& random, int triangles, double half_size, double triangle_size);

}  // namespace octoblisk::testing
