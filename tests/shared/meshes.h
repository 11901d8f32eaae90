// Seeded, closed-form meshes and random poses for tests and benchmarks.
#pragma once

#include <random>

#include "shapes/bodies.h"
#include "shapes/seeded.h"
#include "shapes/sheets.h"

namespace octoblisk::testing {

// The gallery also uses these meshes.
using shapes::boxMesh;
using shapes::bumpySphere;
using shapes::extrudedBand;
using shapes::gear;
using shapes::randomPoint;
using shapes::randomRotation;
using shapes::SharedMesh;
using shapes::torus;
using shapes::tray;
using shapes::trayHeight;
using shapes::uniform;
using shapes::uProfile;
using shapes::waveSheet;

/// A uniform rotation, and a translation of each coordinate within ±half_size.
Pose randomPose(std::mt19937_64& random, double half_size);

/// A triangle with corners within ±half_size.
Triangle randomTriangle(std::mt19937_64& random, double half_size);

/// Thin twisted blades around the z axis, unconnected. To a tree they resemble a blisk.
SharedMesh fan(int blades, int segments);

/// A tube around z. Its outer and inner walls are prisms with `facets` facets. The middle of one facet lies
/// towards x.
SharedMesh tube(double inner, double outer, double half_height, std::uint32_t facets);

/// Random triangles, each of about the given size, within ±half_size; every eighth is degenerate or a
/// duplicate.
SharedMesh soup(std::mt19937_64& random, int triangles, double half_size, double triangle_size);

}  // namespace octoblisk::testing
