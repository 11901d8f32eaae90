#include "octoblisk/triangle_convex.h"

#include "octoblisk/epa.h"
#include "octoblisk/gjk.h"

namespace octoblisk {
namespace {

CorePenetration penetrationOfCore(const Triangle& triangle, const Convex& convex, const GjkResult& search) {
  if (const auto found = epa(triangle, convex, search.simplex)) return *found;
  const Vec3 normal = scaledNormal(triangle);
  const Vec3 direction = normal.squaredNorm() > 0.0 ? Vec3(-normal.normalized()) : Vec3::UnitX();
  return {0.0, direction, search.on_triangle, search.on_core};
}

}  // namespace

std::optional<Contact> contactOf(const Triangle& triangle, const Convex& convex, double threshold) {
  const double radius = convex.radius();
  const GjkResult search = gjk(triangle, convex, threshold + radius);
  if (search.beyond_limit) return std::nullopt;

  const Vec3 apart = search.on_triangle - search.on_core;
  const double core_distance = apart.norm();
  CorePenetration core;
  double distance = core_distance - radius;
  if (search.overlap || core_distance == 0.0) {
    core = penetrationOfCore(triangle, convex, search);
    distance = -core.depth - radius;
  } else {
    core = {0.0, apart / core_distance, search.on_triangle, search.on_core};
  }
  if (distance > threshold) return std::nullopt;
  return Contact{core.on_triangle, core.on_core + radius * core.normal, core.normal, distance, kNoTriangle,
                 kNoTriangle};
}

}  // namespace octoblisk
