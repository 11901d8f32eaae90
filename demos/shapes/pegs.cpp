#include "shapes/pegs.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "shapes/rims.h"

namespace octoblisk::shapes {
namespace {

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

[[noreturn]] void refuse(const char* what, double value) {
  std::ostringstream message;
  message << "a peg or hole cannot have the " << what << ' ' << value;
  throw std::invalid_argument(message.str());
}

void requirePositive(const char* what, double value) {
  if (!(value > 0.0 && std::isfinite(value))) refuse(what, value);
}

void check(const PegInHole& fit) {
  if (fit.sides < 3) refuse("number of sides", fit.sides);
  requirePositive("radius", fit.radius);
  requirePositive("depth", fit.depth);
  if (!(fit.clearance >= 0.0 && std::isfinite(fit.clearance))) refuse("clearance", fit.clearance);
}

}  // namespace

SharedMesh peg(const PegInHole& fit, double length) {
  check(fit);
  requirePositive("length", length);
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
