#include "query/triangle_sweep.h"

#include <algorithm>

#include "geometry/triangle_convex.h"
#include "octoblisk/body_bounds.h"

namespace octoblisk::detail {

std::optional<TriangleImpact> sweep(const Triangle& triangle, const Convex& b, const Motion& b_in_a,
                                    double distance, double tolerance, double until) {
  // A step leaves half of the way to a grazing impact, and little of the way to any other if B does not turn.
  // If it turns, the bound on its speed may be far above its speed: then the impact may be found too early.
  constexpr int kMaxSteps = 1000;
  const double turning = b_in_a.angle() * BodyBounds(b).distanceFromPoint(b_in_a.centerInB());
  const bool is_at_rest = b_in_a.advance().isZero(0.0) && turning == 0.0;
  const double farthest = distance + tolerance + b_in_a.advance().norm() + turning;
  TriangleImpact now{};
  std::optional<TriangleImpact> impact;
  for (int step = 0; step < kMaxSteps; ++step) {
    const std::optional<Contact> contact =
        PosedConvex(b, b_in_a.at(now.fraction)).contactWith(triangle, farthest);
    if (!contact) return std::nullopt;
    now.contact = *contact;
    const double gap = contact->distance - distance;
    if (!impact && gap <= tolerance) impact = now;
    if (gap < -tolerance || (impact && is_at_rest)) return impact;
    const double speed = b_in_a.advance().dot(contact->normal) + turning;
    if (!(speed * (1.0 - now.fraction) > gap + tolerance)) return std::nullopt;
    now.fraction += impact ? std::min((gap + 2.0 * tolerance) / speed, 1.0 - now.fraction) : gap / speed;
    if (!impact && !(now.fraction < until)) return std::nullopt;
  }
  return impact ? impact : now;
}

}  // namespace octoblisk::detail
