#include "contact/inner_contacts.h"

#include <algorithm>
#include <cmath>

#include "query/by_triangles.h"

namespace octoblisk::detail {
namespace {

/// How far a surface must lean towards the other body to remove a contact of its edge or corner; `error` is
/// added for uncertain directions. If the contact pushes on a face, a surface that continues at an angle must
/// lean more: a corner of a body that rocks keeps its contact, although others are nearer.
LocalSurface::Lean leanAt(bool pushes_on_face, double error = 0.0) {
  constexpr double kRocking = 0.3;  // the sine of 17°
  return {kSlightTilt + error, (pushes_on_face ? kRocking : kSlightTilt) + error};
}

}  // namespace

bool isSurelyInner(const SurfacePair& surfaces, const NumberPair& pair, const ClosestFeatures& features,
                   double threshold, bool group_meets) {
  if (!features.areKnown()) return false;
  const Triangle &a = surfaces.a.triangle(pair), &b = surfaces.b.triangle(pair);
  const auto places = features.places(a, b);
  const PlaceOnTriangle &on_a = places.first, &on_b = places.second;
  const auto isOn = [&](const PlaceOnTriangle& place, const SurfaceSide& side) {
    return place.feature != kFace || isOver(side.triangle(pair), side.facing(pair), place.point);
  };
  if (!isOn(on_a, surfaces.a) || !isOn(on_b, surfaces.b)) return false;  // single precision was wrong
  const Vec3 way = on_b.point - on_a.point;
  const double squared = way.squaredNorm(), length = std::sqrt(squared);
  if (!(length <= threshold)) return false;
  // Two planes perpendicular to the way separate the triangles by this gap.
  const auto alongWay = [&](const Vec3& corner) { return way.dot(corner - on_a.point); };
  const double gap = std::min({alongWay(b[0]), alongWay(b[1]), alongWay(b[2])}) -
                     std::max({alongWay(a[0]), alongWay(a[1]), alongWay(a[2])});
  const double least = gap / length;
  if (!(least > 0.0)) return false;
  // The differences of points of two triangles are a convex set. So the direction between points that are
  // nearly the closest ones is off by an angle with at most this tangent.
  const double error = std::sqrt(std::max(0.0, squared - least * least)) / least;
  const double limit = least - surfaces.roundingOf(pair);
  if (!(limit > 0.0)) return false;
  const auto isSurelyTilted = [&](const SurfaceSide& side) {
    const Vec3& facing = side.facing(pair);
    const double tilt = kParallelSine + error;
    return facing.cross(way).squaredNorm() > tilt * tilt * squared * facing.squaredNorm();
  };
  const auto isSurelyInFrontOf = [&](const SurfaceSide& side) {
    const Vec3& facing = side.facing(pair);
    return -side.outward * way.dot(facing) > error * length * facing.norm();
  };
  if (group_meets && !(isSurelyInFrontOf(surfaces.a) && isSurelyInFrontOf(surfaces.b))) return false;
  const auto surfaceComesNearer = [&](const SurfaceSide& own, const PlaceOnTriangle& at,
                                      const SurfaceSide& opposite, const PlaceOnTriangle& opposite_at) {
    if (at.feature == kFace || !isSurelyTilted(own)) return false;
    return own.surface.comesNearer(pair.*own.number, at.feature, at.point, opposite_at.point, limit,
                                   leanAt(!isSurelyTilted(opposite), error));
  };
  return surfaceComesNearer(surfaces.a, on_a, surfaces.b, on_b) ||
         surfaceComesNearer(surfaces.b, on_b, surfaces.a, on_a);
}

void InnerContacts::removeFrom(std::vector<PairedContact>& contacts, const SurfacePair& surfaces,
                               const std::vector<NumberPair>& skipped) {
  groups_.reset(surfaces);
  for (const PairedContact& contact : contacts) groups_.add(contact.pair);
  groups_.add(skipped);
  findDeepest(contacts);
  markPast(contacts, surfaces);
  for (PairedContact& contact : contacts) {
    if (contact.is_removed) continue;
    const double rounding = surfaces.roundingOf(contact.pair);
    contact.is_removed = isInner(contacts, contact, rounding, surfaces.a, surfaces.b) ||
                         isInner(contacts, contact, rounding, surfaces.b, surfaces.a);
  }
  keepDeepest(contacts);
  std::erase_if(contacts, [](const PairedContact& contact) { return contact.is_removed; });
}

/// Finds the deepest contact of each group.
void InnerContacts::findDeepest(const std::vector<PairedContact>& contacts) {
  deepest_.assign(groups_.size(), kNoIndex);
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    std::uint32_t& deepest = deepest_[groups_.groupOf(contacts[c].pair)];
    if (deepest == kNoIndex || contacts[c].distance < contacts[deepest].distance) deepest = c;
  }
}

/// Marks contacts whose triangles are apart, with one triangle on the back of the other, and that are
/// connected to contacts whose triangles meet.
void InnerContacts::markPast(std::vector<PairedContact>& contacts, const SurfacePair& surfaces) {
  constexpr double kBehind = 1e-3;
  const auto isApart = [](const Contact& contact) { return contact.distance > 0.0; };
  is_past_.assign(contacts.size(), false);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    PairedContact& contact = contacts[c];
    if (!isApart(contact) || isApart(contacts[deepest_[groups_.groupOf(contact.pair)]])) continue;
    const auto isOnBack = [&](const SurfaceSide& side) {
      const Vec3& facing = side.facing(contact.pair);
      return side.outward * contact.normal.dot(facing) < -kBehind * facing.norm();
    };
    contact.is_removed = is_past_[c] = isOnBack(surfaces.a) || isOnBack(surfaces.b);
  }
}

/// Whether a contact is at an angle to a body's triangle, at an edge or corner beyond which another triangle
/// of this body leans towards the other body, and comes nearer or meets it.
bool InnerContacts::isInner(const std::vector<PairedContact>& contacts, const PairedContact& contact,
                            double rounding, const SurfaceSide& own, const SurfaceSide& opposite) const {
  if (own.isPerpendicularTo(contact)) return false;
  const Vec3 &point = contact.*own.point, &opposite_point = contact.*opposite.point;
  const unsigned feature = featureOf(own.triangle(contact.pair), own.facing(contact.pair), point);
  if (feature == kFace || feature == 0) return false;
  const std::uint32_t number = contact.pair.*own.number;
  const LocalSurface::Lean least = leanAt(opposite.isPushedBy(contact));
  if (contact.distance > 0.0) {
    const double limit = contact.distance - rounding;
    if (limit > 0.0) return own.surface.comesNearer(number, feature, point, opposite_point, limit, least);
  }
  const Vec3 towards = own.outward * contact.normal;
  return own.surface.leansBeyond(number, feature, towards, least, [&](std::uint32_t other) {
    Contact sought = contact;
    sought.*own.index = own.surface.index(other);
    const auto found = std::ranges::lower_bound(contacts, sought.triangles(), {}, byTriangles);
    if (found == contacts.end() || found->triangles() != sought.triangles()) return false;
    // A triangle that is wholly past the face is deeper than one that meets it.
    return found->distance <= 0.0 || is_past_[static_cast<std::size_t>(found - contacts.begin())];
  });
}

/// Restores the deepest contact of each group that was removed entirely, and the deepest contact of all.
void InnerContacts::keepDeepest(std::vector<PairedContact>& contacts) {
  std::ranges::min_element(contacts, {}, &Contact::distance)->is_removed = false;
  stays_.assign(groups_.size(), false);
  for (const PairedContact& contact : contacts) {
    if (!contact.is_removed) stays_[groups_.groupOf(contact.pair)] = true;
  }
  for (std::uint32_t group = 0; group < groups_.size(); ++group) {
    if (deepest_[group] != kNoIndex && !stays_[group]) contacts[deepest_[group]].is_removed = false;
  }
}

}  // namespace octoblisk::detail
