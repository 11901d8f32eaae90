// The scenes of the dynamics suite.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/dynamics_scene.h"

namespace octoblisk::bench {

struct DynamicsSize {
  int bodies, steps;
};

struct DynamicsEntry {
  std::string name;
  std::string shows;  ///< a title
  std::vector<ShapeKind> kinds;
  DynamicsSize full, quick;  ///< the quick size only checks that the scene runs
  std::function<std::unique_ptr<DynamicsScene>(ShapeKind kind, int bodies)> make;
  bool is_chaotic = false;  ///< more runs, with other numbers of bodies, then measure when all sleep
};

const std::vector<DynamicsEntry>& dynamicsEntries();

/// Copies of one mesh in a square pit on a plane, dropped in layers with random orientations.
std::unique_ptr<DynamicsScene> makeTrefoilPile(ShapeKind kind, int bodies);
std::unique_ptr<DynamicsScene> makeJackPile(ShapeKind kind, int bodies);
std::unique_ptr<DynamicsScene> makeTeddyPile(ShapeKind kind, int bodies);

/// Tori, gears, U-profiles and bumpy stones on a concave floor. The floor is a mesh too.
std::unique_ptr<DynamicsScene> makeMixedPile(ShapeKind kind, int bodies);

/// Towers of ten flat cylinders on flat floors of triangles, placed with offsets of up to 1 mm. They never
/// sleep. `cylinders` is a multiple of ten.
std::unique_ptr<DynamicsScene> makeTowers(ShapeKind kind, int cylinders);

/// Linked tori that hang from a fixed one.
std::unique_ptr<DynamicsScene> makeChain(ShapeKind kind, int links);

/// Hulls, boxes, balls and U-profiles fall into a static channel. Its walls are curved like two blades.
std::unique_ptr<DynamicsScene> makeChannel(ShapeKind kind, int bodies);

/// M16 nuts of 11,360 triangles run down bolts without friction. Units: millimetres. A step is 1/240 s.
std::unique_ptr<DynamicsScene> makeNuts(ShapeKind kind, int nuts);

/// Round and square pegs, 16 mm wide and 32 mm long, drop into holes with a clearance of 0.1 mm on each side,
/// from 1 mm above and 0.05 mm aside. Units: millimetres. A step is 1/240 s.
std::unique_ptr<DynamicsScene> makePegs(ShapeKind kind, int pegs);

/// Convex hulls of 6 mm fall onto the default blisk. Units: millimetres. A step is 1/240 s.
std::unique_ptr<DynamicsScene> makeHullsOnBlisk(ShapeKind kind, int hulls);

}  // namespace octoblisk::bench
