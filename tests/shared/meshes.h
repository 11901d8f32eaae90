// Meshes and random poses for tests and benchmarks. All seeded, all closed forms.
#pragma once

#include <memory>
#include <random>

#include "shapes/bodies.h"
#include "shapes/seeded.h"
#include "shapes/sheets.h"

namespace octoblisk::testing {

// Those that the gallery shows, too.
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

/// Thin twisted blades round the z axis, not joined: what a blisk is like to a tree.
SharedMesh fan(int blades, int segments);

/// A tube round z whose outer and inner walls are prisms of so many facets; a facet's middle is towards x.
SharedMesh tube(double inner, double outer, double half_height, std::uint32_t facets);

/// Random triangles, each of about the given size, within ±half_size; every eighth is degenerate or a
/// duplicate.
SharedMesh soup(std::mt19937_64& random, int triangles, double half_size, double triangle_size);

}  // namespace octoblisk::testing
