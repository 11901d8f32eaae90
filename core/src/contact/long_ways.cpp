#include "contact/long_ways.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/triangle_pair.h"

namespace octoblisk::detail {
namespace {

/// Whether two triangles are nearer than `distance`, which is above 0.
bool areWithin(double distance, const Triangle& a, const Triangle& b) {
  const auto isOfB = [&](const Vec3& corner) { return hasCorner(b, corner); };
  return std::ranges::any_of(a, isOfB) || contactOf(a, b).distance < distance;
}

}  // namespace

/// Whether each of two faces is below or on the other's plane, as at a convex edge or on the two sides of a
/// sheet. False if `other` has no area.
bool LongWays::isConvex(const Face& face, const Face& other) {
  constexpr double kOn = 1e-4;  // as a fraction of the triangle's size
  const auto isBelow = [](const Face& low, const Face& high) {
    const Triangle& t = low.triangle;
    const double most = -kOn * ((t[1] - t[0]).norm() + (t[2] - t[0]).norm());
    return high.depthOf(t[0]) >= most && high.depthOf(t[1]) >= most && high.depthOf(t[2]) >= most;
  };
  return !other.facing.isZero() && isBelow(face, other) && isBelow(other, face);
}

void LongWays::removeFrom(std::vector<PairedContact>& contacts, const SurfacePair& surfaces) {
  if (std::ranges::none_of(contacts, [](const Contact& contact) { return contact.distance < 0.0; })) return;
  const auto markWaysOutOf = [&](const SurfaceSide& own, const SurfaceSide& opposite) {
    sortByTriangle(contacts, opposite);
    for (std::size_t number = 0; number < opposite.surface.size(); ++number) {
      const Members opposite_one =
          Members(by_triangle_).subspan(first_[number], first_[number + 1] - first_[number]);
      mark(contacts, opposite_one, own, opposite);
    }
  };
  markWaysOutOf(surfaces.a, surfaces.b);
  markWaysOutOf(surfaces.b, surfaces.a);
  std::erase_if(contacts, [](const PairedContact& contact) { return contact.is_removed; });
}

/// Lists the contacts of each triangle of one side in by_triangle_, from first_[number] to first_[number +
/// 1].
void LongWays::sortByTriangle(const std::vector<PairedContact>& contacts, const SurfaceSide& side) {
  first_.assign(side.surface.size() + 2, 0);
  for (const PairedContact& contact : contacts) ++first_[contact.pair.*side.number + 2];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  by_triangle_.resize(contacts.size());
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    by_triangle_[first_[contacts[c].pair.*side.number + 1]++] = c;
  }
}

/// Marks contacts with one triangle of the other body that are perpendicular to a face of this body although
/// another face of this body meets the triangle far less deep. The two faces must be below each other's
/// planes, and the other face
/// - is near the triangle's deepest point, or
/// - is near the first face, while the deepest point is outside the body, over that other face or a third
///   one.
void LongWays::mark(std::vector<PairedContact>& contacts, Members opposite_one, const SurfaceSide& own,
                    const SurfaceSide& opposite) {
  if (opposite_one.size() < 2) return;
  faces_.clear();
  for (const std::uint32_t c : opposite_one) {
    PairedContact& contact = contacts[c];
    if (!(contact.distance < 0.0) || !own.isPerpendicularTo(contact)) continue;
    if (faces_.empty()) findFaces(contacts, opposite_one, own);
    const Face face = {own.triangle(contact.pair), own.facing(contact.pair).normalized(), contact.distance};
    const Vec3& deepest = contact.*opposite.point;
    const double half_way = -0.5 * contact.distance;
    const auto isOutOver = [&](const Face& other) {
      return other.depthOf(deepest) < -0.1 * half_way && isConvex(face, other);
    };
    std::optional<bool> is_out;
    const auto isShortWay = [&](const Face& other) {
      if (other.contact_distance <= -half_way) return false;
      if (other.depthOf(deepest) < half_way && isConvex(face, other) &&
          distance(other.triangle, deepest) < half_way) {
        return true;
      }
      if (!is_out) is_out = std::ranges::any_of(faces_, isOutOver);
      return *is_out && isConvex(face, other) && areWithin(half_way, face.triangle, other.triangle);
    };
    if (std::ranges::any_of(faces_, isShortWay)) contact.is_removed = true;
  }
}

/// Collects faces that meet a triangle, from the least deep contacts. Their number is limited, so that a
/// large triangle under a fine mesh does not take quadratic time.
void LongWays::findFaces(const std::vector<PairedContact>& contacts, Members opposite_one,
                         const SurfaceSide& own) {
  constexpr std::size_t kMax = 256;
  shallowest_.clear();
  std::ranges::copy_if(opposite_one, std::back_inserter(shallowest_),
                       [&](std::uint32_t c) { return contacts[c].distance <= 0.0; });
  if (shallowest_.size() > kMax) {
    // Among equally deep contacts, take the first ones, so that the result is the same on every machine.
    const auto depthOf = [&](std::uint32_t c) { return std::pair(-contacts[c].distance, c); };
    std::ranges::nth_element(shallowest_, shallowest_.begin() + kMax, {}, depthOf);
    shallowest_.resize(kMax);
  }
  for (const std::uint32_t c : shallowest_) {
    faces_.push_back(
        {own.triangle(contacts[c].pair), own.facing(contacts[c].pair).normalized(), contacts[c].distance});
  }
}

}  // namespace octoblisk::detail
