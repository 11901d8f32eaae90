#include "shapes/pegs.h"

#include <cmath>
#include <numbers>

#include "shapes/dimensions.h"
#include "shapes/rims.h"

namespace octoblisk::shapes {
namespace {

constexpr const char* kPeg = "a peg or hole";

/// Around a circle of the radius.
Rim polygon(Welded& mesh, int sides, double radius, double z) {
  const double half_side = std::numbers::pi / sides, corner = radius / std::cos(half_side);
  Rim rim;
  for (int side = 0; side < sides; ++side) {
    const double angle = (2 * side + 1) * half_side;
    rim.push_back(mesh.vertex({corner * std::cos(angle), corner * std::sin(angle), z}));
  }
  return rim;
}

void check(const PegInHole& fit) {
  if (fit.sides < 3) refuse(kPeg, "number of sides", fit.sides);
  requirePositive(kPeg, "radius", fit.radius);
  requirePositive(kPeg, "depth", fit.depth);
  requireNotNegative(kPeg, "clearance", fit.clearance);
}

}  // namespace

SharedMesh peg(const PegInHole& fit, double length) {
  check(fit);
  requirePositive(kPeg, "length", length);
  Welded mesh;
  const Rim low = polygon(mesh, fit.sides, fit.radius, 0.0),
            high = polygon(mesh, fit.sides, fit.radius, length);
  addDisk(mesh, high, length);
  addWall(mesh, low, high);
  addDisk(mesh, reversed(low), 0.0);
  return mesh.mesh();
}

SharedMesh hole(const PegInHole& fit) {
  check(fit);
  Welded mesh;
  const double bore = fit.radius + fit.clearance, block = bore + fit.radius;
  const Rim floor = polygon(mesh, fit.sides, bore, 0.0), mouth = polygon(mesh, fit.sides, bore, fit.depth),
            low = polygon(mesh, fit.sides, block, -fit.radius),
            high = polygon(mesh, fit.sides, block, fit.depth);
  addDisk(mesh, floor, 0.0);
  addWall(mesh, reversed(floor), reversed(mouth));  // faces the axis
  addRing(mesh, mouth, high);
  addWall(mesh, low, high);
  addDisk(mesh, reversed(low), -fit.radius);
  return mesh.mesh();
}

}  // namespace octoblisk::shapes
