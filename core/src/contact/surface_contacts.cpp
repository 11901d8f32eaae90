#include "contact/surface_contacts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/triangle_feature.h"
#include "geometry/triangle_pair.h"

namespace octoblisk::detail {
namespace {

/// The sine of a tilt of a contact's normal that means nothing: 0.6°.
constexpr double kSlightTilt = 0.01;

std::uint32_t rootOf(std::vector<std::uint32_t>& parent, std::uint32_t contact) {
  while (parent[contact] != contact) contact = parent[contact] = parent[parent[contact]];
  return contact;
}

/// Sorts the contacts by one of their triangles and calls visit(contacts) for the contacts of each triangle.
template <typename Visit>
void forEachOfOne(std::uint32_t Contact::*triangle, const std::vector<Contact>& contacts,
                  std::vector<std::uint32_t>& order, Visit&& visit) {
  const auto triangleOf = [&](std::uint32_t c) { return contacts[c].*triangle; };
  const auto place = [&](std::uint32_t c) { return std::pair(triangleOf(c), c); };
  if (!std::ranges::is_sorted(order, {}, place)) std::ranges::sort(order, {}, place);
  for (auto first = order.begin(); first != order.end();) {
    const auto last = std::find_if(first, order.end(),
                                   [&](std::uint32_t c) { return triangleOf(c) != triangleOf(*first); });
    visit(std::span<const std::uint32_t>(first, last));
    first = last;
  }
}

}  // namespace

SurfaceContacts::Face::Face(const Triangle& of, double contact)
    : triangle(of), facing(scaledNormal(of).normalized()), contact_distance(contact) {}

/// Whether each of two faces is below or on the other's plane, as at a convex edge or on the two sides of a
/// sheet. False if `other` has no area.
bool SurfaceContacts::isConvex(const Face& face, const Face& other) {
  constexpr double kOn = 1e-4;  // as a fraction of the triangle's size
  const auto isBelow = [](const Face& low, const Face& high) {
    const Triangle& t = low.triangle;
    const double most = -kOn * ((t[1] - t[0]).norm() + (t[2] - t[0]).norm());
    return high.depthOf(t[0]) >= most && high.depthOf(t[1]) >= most && high.depthOf(t[2]) >= most;
  };
  return !other.facing.isZero() && isBelow(face, other) && isBelow(other, face);
}

void SurfaceContacts::filter(std::vector<Contact>& contacts) {
  if (contacts.size() < 2) return;
  removeLongWays(contacts);
  join(contacts);
  markPast(contacts);
  forEachOfOne(&Contact::triangle_b, contacts, by_b_,
               [&](Members opposite_one) { markInner(contacts, opposite_one, true); });
  forEachOfOne(&Contact::triangle_a, contacts, by_a_,
               [&](Members opposite_one) { markInner(contacts, opposite_one, false); });
  keepDeepest(contacts);
  dropRemoved(contacts);
  alignWithFaces(contacts);
}

/// Contacts of edges and corners between nearly parallel faces have slightly tilted normals. A normal within
/// this tilt of the perpendicular to one of the two faces becomes that perpendicular. The middle between the
/// points stays, and so does the distance.
void SurfaceContacts::alignWithFaces(std::vector<Contact>& contacts) const {
  constexpr double kAlong = 1.0 - 0.5 * kSlightTilt * kSlightTilt;  // the cosine
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    Contact& contact = contacts[c];
    Vec3& normal = contact.normal;
    const Vec3 of_a = scaledNormal(pairs_[c].a), of_b = scaledNormal(pairs_[c].b);
    if (isPerpendicular(of_a, normal) || isPerpendicular(of_b, normal)) continue;
    const auto cosineTo = [&](const Vec3& facing) {
      const double length = facing.norm();
      return length > 0.0 ? facing.dot(normal) / length : 0.0;
    };
    const double along_a = cosineTo(of_a), along_b = cosineTo(of_b);
    const bool is_a_closer = std::abs(along_a) >= std::abs(along_b);
    const double along = is_a_closer ? along_a : along_b;
    if (!(std::abs(along) > kAlong)) continue;
    normal = std::copysign(1.0, along) * (is_a_closer ? of_a : of_b).normalized();
    const Vec3 middle = 0.5 * (contact.point_on_a + contact.point_on_b);
    contact.point_on_a = middle + 0.5 * contact.distance * normal;
    contact.point_on_b = middle - 0.5 * contact.distance * normal;
  }
}

void SurfaceContacts::dropRemoved(std::vector<Contact>& contacts) {
  std::size_t kept = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (removed_[c] != Removed::no) continue;
    contacts[kept] = contacts[c];
    pairs_[kept++] = pairs_[c];
  }
  contacts.resize(kept);
  pairs_.resize(kept);
}

/// Keeps all contacts, in the given order.
void SurfaceContacts::reset(std::size_t contacts) {
  removed_.assign(contacts, Removed::no);
  for (auto* indices : {&by_a_, &by_b_}) {
    indices->resize(contacts);
    std::iota(indices->begin(), indices->end(), 0u);
  }
}

/// This comes first, because the depths of these contacts are meaningless.
void SurfaceContacts::removeLongWays(std::vector<Contact>& contacts) {
  reset(contacts.size());
  forEachOfOne(&Contact::triangle_b, contacts, by_b_,
               [&](Members opposite_one) { markLongWays(contacts, opposite_one, true); });
  forEachOfOne(&Contact::triangle_a, contacts, by_a_,
               [&](Members opposite_one) { markLongWays(contacts, opposite_one, false); });
  const std::size_t before = contacts.size();
  dropRemoved(contacts);
  if (contacts.size() < before) reset(contacts.size());
}

/// Marks contacts with one triangle of the other body that are perpendicular to a face of this body although
/// another face of this body meets the triangle far less deep. The two faces must be below each other's
/// planes, and the other face
/// - is near the triangle's deepest point, or
/// - is near the first face, while the deepest point is outside the body, over that other face or a third
///   one.
void SurfaceContacts::markLongWays(const std::vector<Contact>& contacts, Members opposite_one, bool of_a) {
  if (opposite_one.size() < 2) return;
  faces_.clear();
  for (const std::uint32_t c : opposite_one) {
    const Contact& contact = contacts[c];
    const Triangle& own = of_a ? pairs_[c].a : pairs_[c].b;
    if (!(contact.distance < 0.0) || !isPerpendicular(scaledNormal(own), contact.normal)) continue;
    if (faces_.empty()) findFaces(contacts, opposite_one, of_a);
    const Face face(own, contact.distance);
    const Vec3& deepest = of_a ? contact.point_on_b : contact.point_on_a;
    const double half_way = -0.5 * contact.distance;
    const auto isOver = [&](const Face& other) {
      return other.depthOf(deepest) < -0.1 * half_way && isConvex(face, other);
    };
    std::optional<bool> is_out;
    const auto isShortWay = [&](const Face& other) {
      if (other.contact_distance <= -half_way) return false;
      if (other.depthOf(deepest) < half_way && isConvex(face, other) &&
          closestPoints(other.triangle, {deepest, deepest, deepest}).distance < half_way) {
        return true;
      }
      if (!is_out) is_out = std::ranges::any_of(faces_, isOver);
      return *is_out && isConvex(face, other) && contactOf(own, other.triangle).distance < half_way;
    };
    if (std::ranges::any_of(faces_, isShortWay)) removed_[c] = Removed::long_way;
  }
}

/// Collects faces that meet a triangle, from the least deep contacts. Their number is limited, so that a
/// large triangle under a fine mesh does not take quadratic time.
void SurfaceContacts::findFaces(const std::vector<Contact>& contacts, Members opposite_one, bool of_a) {
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
    faces_.emplace_back(of_a ? pairs_[c].a : pairs_[c].b, contacts[c].distance);
  }
}

/// Groups contacts that are connected by triangles. The root of a group is its deepest contact.
void SurfaceContacts::join(const std::vector<Contact>& contacts) {
  parent_.resize(contacts.size());
  std::iota(parent_.begin(), parent_.end(), 0u);
  const auto joinAll = [&](Members of_one) {
    for (const std::uint32_t c : of_one.subspan(1)) {
      std::uint32_t a = rootOf(parent_, of_one.front()), b = rootOf(parent_, c);
      if (contacts[b].distance < contacts[a].distance) std::swap(a, b);
      parent_[b] = a;
    }
  };
  forEachOfOne(&Contact::triangle_a, contacts, by_a_, joinAll);
  forEachOfOne(&Contact::triangle_b, contacts, by_b_, joinAll);
}

/// Restores the deepest contact of each group that was removed entirely, and the deepest contact of all.
void SurfaceContacts::keepDeepest(const std::vector<Contact>& contacts) {
  const auto deepest = std::ranges::min_element(contacts, {}, &Contact::distance) - contacts.begin();
  removed_[static_cast<std::size_t>(deepest)] = Removed::no;
  stays_.assign(parent_.size(), false);
  for (std::uint32_t c = 0; c < parent_.size(); ++c) {
    if (removed_[c] == Removed::no) stays_[rootOf(parent_, c)] = true;
  }
  for (std::uint32_t c = 0; c < parent_.size(); ++c) {
    if (parent_[c] == c && !stays_[c]) removed_[c] = Removed::no;
  }
}

/// Marks contacts whose triangles are apart, with one triangle on the back of the other, and that are
/// connected to contacts whose triangles meet.
void SurfaceContacts::markPast(const std::vector<Contact>& contacts) {
  const auto isApart = [](const Contact& contact) { return contact.distance > 0.0; };
  constexpr double kBehind = 1e-3;
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    if (!isApart(contact) || isApart(contacts[rootOf(parent_, c)])) continue;
    const Vec3 facing_a = scaledNormal(pairs_[c].a), facing_b = scaledNormal(pairs_[c].b);
    if (contact.normal.dot(facing_a) > kBehind * facing_a.norm() ||
        contact.normal.dot(facing_b) < -kBehind * facing_b.norm()) {
      removed_[c] = Removed::past;
    }
  }
}

/// Marks contacts with one triangle of the other body that are at an angle to this body's triangle, at an
/// edge or corner beyond which another triangle of this body leans towards the other body.
void SurfaceContacts::markInner(const std::vector<Contact>& contacts, Members opposite_one, bool of_a) {
  if (opposite_one.size() < 2) return;
  const auto ownOf = [&](std::uint32_t c) -> const Triangle& { return of_a ? pairs_[c].a : pairs_[c].b; };
  corners_.clear();
  for (const std::uint32_t c : opposite_one) {
    const Contact& contact = contacts[c];
    const Triangle& own = ownOf(c);
    if (removed_[c] != Removed::no) continue;
    const Vec3 normal = scaledNormal(own);
    if (isPerpendicular(normal, contact.normal)) continue;
    const unsigned feature = featureOf(own, normal, of_a ? contact.point_on_a : contact.point_on_b);
    if (feature == 0b111u || feature == 0) continue;
    if (corners_.empty()) {
      for (const std::uint32_t o : opposite_one) corners_.add(ownOf(o), o);
      corners_.sort();
    }
    const auto [first, second] = endsOf(feature);
    const Vec3 towards = of_a ? Vec3(-contact.normal) : contact.normal;
    const double size = (own[1] - own[0]).norm() + (own[2] - own[0]).norm();
    corners_.forEachAt(own[first], [&](std::uint32_t o) {
      const Contact& other = contacts[o];
      // A triangle that is wholly past the face is deeper than one that meets it.
      const bool is_nearer = contact.distance > 0.0 ? other.distance < contact.distance - 1e-9 * size
                                                    : other.distance <= 0.0 || removed_[o] == Removed::past;
      if (o == c || !is_nearer) return false;
      const Triangle& shares = ownOf(o);
      if (!hasCorner(shares, own[first]) || !hasCorner(shares, own[second])) return false;
      if (!leansOver(shares, own[first], own[second], towards, kSlightTilt)) return false;
      removed_[c] = Removed::inner;
      return true;
    });
  }
}

}  // namespace octoblisk::detail
