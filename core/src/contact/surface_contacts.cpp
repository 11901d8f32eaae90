#include "contact/surface_contacts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/triangle_feature.h"
#include "geometry/triangle_pair.h"
#include "query/near_pairs.h"
#include "tree/tree.h"

namespace octoblisk::detail {
namespace {

/// The sine of a tilt of a contact's normal that means nothing: 0.6°.
constexpr double kSlightTilt = 0.01;

/// How far a surface must lean towards the other body to remove a contact of its edge or corner; `error` is
/// added for uncertain directions. If the contact pushes on a face, a surface that continues at an angle must
/// lean more: a corner of a body that rocks keeps its contact, although others are nearer.
LocalSurface::Lean leanAt(bool pushes_on_face, double error = 0.0) {
  constexpr double kRocking = 0.3;  // the sine of 17°
  return {kSlightTilt + error, (pushes_on_face ? kRocking : kSlightTilt) + error};
}

/// Whether a contact pushes perpendicularly on the outside of a face. `outward` is the contact's normal, or
/// against it, so that it points from the face's body to the other.
bool isOnFace(const Vec3& facing, const Vec3& outward) {
  return isPerpendicular(facing, outward) && facing.dot(outward) > 0.0;
}

constexpr std::uint32_t kNone = 0xffffffffu;

auto trianglesOf(const Contact& contact) { return TrianglePair{contact.triangle_a, contact.triangle_b}; }

/// Whether two triangles are nearer than `distance`, which is above 0.
bool areWithin(double distance, const Triangle& a, const Triangle& b) {
  const auto isOfB = [&](const Vec3& corner) { return hasCorner(b, corner); };
  return std::ranges::any_of(a, isOfB) || contactOf(a, b).distance < distance;
}

/// Slack for the rounding of distances between two triangles, and between their neighbours.
double roundingOf(const Triangle& a, const Triangle& b) {
  double farthest = 0.0, longest = 0.0;
  for (const Triangle* const triangle : {&a, &b}) {
    for (const Vec3& corner : *triangle) {
      farthest = std::max(farthest, corner.cwiseAbs().maxCoeff());
      longest = std::max(longest, (corner - a[0]).squaredNorm());
    }
  }
  return 1e-9 * std::sqrt(longest) + 1e-14 * farthest;
}

/// Places the points of a contact at its distance along its normal.
void placeAround(const Vec3& middle, Contact& contact) {
  contact.point_on_a = middle + 0.5 * contact.distance * contact.normal;
  contact.point_on_b = middle - 0.5 * contact.distance * contact.normal;
}

/// Overwrites `order`, and calls visit(contacts) for the contacts of each triangle A or B.
template <typename Visit>
void forEachOfOne(std::uint32_t Contact::*triangle, const std::vector<Contact>& contacts,
                  std::vector<std::uint32_t>& order, Visit&& visit) {
  order.resize(contacts.size());
  std::iota(order.begin(), order.end(), 0u);
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

void SurfaceContacts::clear() {
  surface_a_.clear();
  surface_b_.clear();
  pairs_.clear();
  skipped_.clear();
  meeting_.clear();
}

SurfaceContacts::Pair SurfaceContacts::add(std::uint32_t index_a, const Triangle& a, std::uint32_t index_b,
                                           const Triangle& b) {
  return {surface_a_.add(index_a, a), surface_b_.add(index_b, b)};
}

void SurfaceContacts::find(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a,
                           double threshold, std::vector<Contact>& found) {
  found.clear();
  clear();
  nearPairs(treeOf(a), treeOf(b), b_in_a, threshold, near_);
  for (const NearPair& near : near_) {
    const auto [triangle_a, triangle_b] = near.triangles;
    pairs_.push_back(
        add(triangle_a, a.mesh().triangle(triangle_a), triangle_b, b_in_a * b.mesh().triangle(triangle_b)));
  }
  // Where triangles of a group meet, contacts that filter removes decide about others.
  findGroups({&pairs_});
  may_meet_.assign(parent_.size(), false);
  for (std::size_t n = 0; n < near_.size(); ++n) {
    if (near_[n].meeting != Meeting::no) may_meet_[groupOf(pairs_[n])] = true;
  }
  order_.clear();
  for (std::uint32_t n = 0; n < near_.size(); ++n) {
    if (!may_meet_[groupOf(pairs_[n])] && isSurelyInner(near_[n].features, pairs_[n], threshold)) {
      skipped_.push_back(pairs_[n]);
    } else {
      order_.push_back(n);
    }
  }
  std::ranges::sort(order_, {}, [&](std::uint32_t n) { return near_[n].triangles; });
  of_contacts_.clear();
  for (const std::uint32_t n : order_) {
    const Pair& pair = pairs_[n];
    const std::optional<Contact> contact =
        contactWithin(threshold, near_[n], surface_a_.triangle(pair.a), surface_b_.triangle(pair.b));
    if (!contact) continue;
    found.push_back(*contact);
    of_contacts_.push_back(pair);
  }
  pairs_.assign(of_contacts_.begin(), of_contacts_.end());
  filter(found, threshold);
}

/// Whether two triangles that do not meet are surely within the threshold, and the surface of one of them
/// surely comes nearer beyond the edge or corner where they are closest.
bool SurfaceContacts::isSurelyInner(const ClosestFeatures& features, const Pair& pair,
                                    double threshold) const {
  constexpr double kPerpendicular = 1.5e-3;  // the sine of isPerpendicular's tolerance
  const Triangle &a = surface_a_.triangle(pair.a), &b = surface_b_.triangle(pair.b);
  const auto places = features.places(a, b);
  const PlaceOnTriangle &on_a = places.first, &on_b = places.second;
  const auto isOn = [](const PlaceOnTriangle& place, const Triangle& triangle) {
    return place.feature != 0b111u || isOver(triangle, scaledNormal(triangle), place.point);
  };
  if (!isOn(on_a, a) || !isOn(on_b, b)) return false;  // single precision was wrong
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
  const double limit = least - roundingOf(a, b);
  if (!(limit > 0.0)) return false;
  const auto isSurelyTilted = [&](const Triangle& triangle) {
    const Vec3 facing = scaledNormal(triangle);
    const double tilt = kPerpendicular + error;
    return facing.cross(way).squaredNorm() > tilt * tilt * squared * facing.squaredNorm();
  };
  const auto isInner = [&](const LocalSurface& surface, std::uint32_t number, const PlaceOnTriangle& own,
                           const Triangle& other, const Vec3& opposite) {
    if (own.feature == 0b111u || !isSurelyTilted(surface.triangle(number))) return false;
    return surface.comesNearer(number, own.feature, own.point, opposite, limit,
                               leanAt(!isSurelyTilted(other), error));
  };
  return isInner(surface_a_, pair.a, on_a, b, on_b.point) || isInner(surface_b_, pair.b, on_b, a, on_a.point);
}

void SurfaceContacts::filter(std::vector<Contact>& contacts, double threshold) {
  if (!contacts.empty() && contacts.size() + skipped_.size() >= 2) removeWrong(contacts);
  addCorners(contacts, threshold);
}

void SurfaceContacts::removeWrong(std::vector<Contact>& contacts) {
  removed_.assign(contacts.size(), Removed::no);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].distance <= 0.0) meeting_.push_back(pairs_[c]);
  }
  removeLongWays(contacts);
  findGroups({&pairs_, &skipped_});
  findDeepest(contacts);
  markPast(contacts);
  markInner(contacts);
  keepDeepest(contacts);
  dropRemoved(contacts);
  alignWithFaces(contacts);
}

/// Appends a contact for each other corner of a triangle that is over the face on which its contact pushes. A
/// triangle has one contact, at its nearest point, but may lie on the face.
void SurfaceContacts::addCorners(std::vector<Contact>& contacts, double threshold) {
  const std::size_t count = contacts.size();
  for (std::size_t c = 0; c < count; ++c) {
    const Triangle &a = surface_a_.triangle(pairs_[c].a), &b = surface_b_.triangle(pairs_[c].b);
    const Contact of_pair = contacts[c];
    const double rounding = roundingOf(a, b);
    // `from_face` is 1 if normals point from this face to the corners, or else -1.
    const auto add = [&](const Triangle& triangle, Vec3 Contact::*on_triangle, const Triangle& face,
                         Vec3 Contact::*on_face, double from_face) {
      const Vec3 facing = scaledNormal(face);
      if (!isOnFace(facing, from_face * of_pair.normal)) return;
      const Vec3 outward =
          facing.normalized();  // heights along the contact's normal are wrong far from face[0]
      for (const Vec3& corner : triangle) {
        const double height = outward.dot(corner - face[0]);
        if (!(height <= threshold) || (corner - of_pair.*on_triangle).norm() <= rounding ||
            !isOver(face, facing, corner))
          continue;
        Contact contact = of_pair;
        contact.*on_triangle = corner;
        contact.*on_face = corner - height * outward;
        contact.normal = from_face * outward;
        contact.distance = height;
        contacts.push_back(contact);
        pairs_.push_back(pairs_[c]);
      }
    };
    add(a, &Contact::point_on_a, b, &Contact::point_on_b, 1.0);
    add(b, &Contact::point_on_b, a, &Contact::point_on_a, -1.0);
  }
}

/// Contacts of edges and corners between nearly parallel faces have slightly tilted normals. A normal within
/// this tilt of the perpendicular to one of the two faces becomes that perpendicular. The middle between the
/// points stays, and so does the distance.
void SurfaceContacts::alignWithFaces(std::vector<Contact>& contacts) const {
  constexpr double kAlong = 1.0 - 0.5 * kSlightTilt * kSlightTilt;  // the cosine
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    Contact& contact = contacts[c];
    Vec3& normal = contact.normal;
    const Vec3 of_a = scaledNormal(surface_a_.triangle(pairs_[c].a)),
               of_b = scaledNormal(surface_b_.triangle(pairs_[c].b));
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
    placeAround(0.5 * (contact.point_on_a + contact.point_on_b), contact);
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

/// This comes first, because the depths of these contacts are meaningless.
void SurfaceContacts::removeLongWays(std::vector<Contact>& contacts) {
  if (std::ranges::none_of(contacts, [](const Contact& contact) { return contact.distance < 0.0; })) return;
  forEachOfOne(&Contact::triangle_b, contacts, order_,
               [&](Members opposite_one) { markLongWays(contacts, opposite_one, true); });
  forEachOfOne(&Contact::triangle_a, contacts, order_,
               [&](Members opposite_one) { markLongWays(contacts, opposite_one, false); });
  dropRemoved(contacts);
  removed_.assign(contacts.size(), Removed::no);
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
    const Triangle& own = of_a ? surface_a_.triangle(pairs_[c].a) : surface_b_.triangle(pairs_[c].b);
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
          distance(other.triangle, deepest) < half_way) {
        return true;
      }
      if (!is_out) is_out = std::ranges::any_of(faces_, isOver);
      return *is_out && isConvex(face, other) && areWithin(half_way, own, other.triangle);
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
    faces_.emplace_back(of_a ? surface_a_.triangle(pairs_[c].a) : surface_b_.triangle(pairs_[c].b),
                        contacts[c].distance);
  }
}

/// Groups pairs that are connected by triangles.
void SurfaceContacts::findGroups(std::initializer_list<const std::vector<Pair>*> of) {
  parent_.resize(surface_a_.size() + surface_b_.size());
  std::iota(parent_.begin(), parent_.end(), 0u);
  for (const std::vector<Pair>* const pairs : of) {
    for (const Pair& pair : *pairs) parent_[rootOf(surface_a_.size() + pair.b)] = rootOf(pair.a);
  }
}

/// Finds the deepest contact of each group.
void SurfaceContacts::findDeepest(const std::vector<Contact>& contacts) {
  deepest_.assign(parent_.size(), kNone);
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    std::uint32_t& deepest = deepest_[groupOf(pairs_[c])];
    if (deepest == kNone || contacts[c].distance < contacts[deepest].distance) deepest = c;
  }
}

std::uint32_t SurfaceContacts::rootOf(std::uint32_t node) {
  while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
  return node;
}

/// Restores the deepest contact of each group that was removed entirely, and the deepest contact of all.
void SurfaceContacts::keepDeepest(const std::vector<Contact>& contacts) {
  const auto deepest = std::ranges::min_element(contacts, {}, &Contact::distance) - contacts.begin();
  removed_[static_cast<std::size_t>(deepest)] = Removed::no;
  stays_.assign(parent_.size(), false);
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    if (removed_[c] == Removed::no) stays_[groupOf(pairs_[c])] = true;
  }
  for (std::uint32_t node = 0; node < parent_.size(); ++node) {
    if (deepest_[node] != kNone && !stays_[node]) removed_[deepest_[node]] = Removed::no;
  }
}

/// Whether two triangles face each other along their contact, as at the wall of a hole, not where one body
/// crosses the other.
bool SurfaceContacts::areFacing(const Contact& contact, const Pair& pair) const {
  constexpr double kFacing = 0.55;  // a cosine; of the faces at a box's corner, one has at least 0.577
  const Vec3 of_a = scaledNormal(surface_a_.triangle(pair.a)),
             of_b = scaledNormal(surface_b_.triangle(pair.b));
  return of_a.dot(contact.normal) < -kFacing * of_a.norm() &&
         of_b.dot(contact.normal) > kFacing * of_b.norm();
}

void SurfaceContacts::openPinches(std::vector<Contact>& contacts) {
  order_.clear();  // of contacts that may pinch
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].distance <= 0.0 && !areFacing(contacts[c], pairs_[c])) order_.push_back(c);
  }
  if (order_.empty()) return;
  curve_.clear();
  for (const Pair& pair : meeting_) curve_.add(surface_a_.triangle(pair.a), surface_b_.triangle(pair.b));
  if (!curve_.wayOut()) return;  // one body may pierce the other
  removed_.assign(contacts.size(), Removed::no);
  findGroups({&meeting_});
  std::ranges::sort(order_, {}, [&](std::uint32_t c) { return std::pair(groupOf(pairs_[c]), c); });
  for (auto first = order_.begin(); first != order_.end();) {
    const std::uint32_t group = groupOf(pairs_[*first]);
    const auto last =
        std::find_if(first, order_.end(), [&](std::uint32_t c) { return groupOf(pairs_[c]) != group; });
    openPinch(contacts, {first, last}, group);
    first = last;
  }
  dropRemoved(contacts);
}

/// Opens one crossing: a group of pairs that meet. The members are its contacts that may pinch. Where bars
/// cross, the curve extends as far as they overlap. An end that pokes into a side has a flat curve: without
/// another way out, the depth is that of the triangles.
void SurfaceContacts::openPinch(std::vector<Contact>& contacts, Members members, std::uint32_t group) {
  curve_.clear();
  for (const Pair& pair : meeting_) {
    if (groupOf(pair) == group) curve_.add(surface_a_.triangle(pair.a), surface_b_.triangle(pair.b));
  }
  const std::optional<Vec3> out = curve_.wayOut();
  if (!out) return;
  constexpr double kOpposed = 0.9, kAcross = 0.5, kOut = 0.2;  // cosines
  const auto isAnyPushing = [&](const Vec3& direction, double least_cosine) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const bool pushes = contacts[c].distance <= 0.0 && contacts[c].normal.dot(direction) > least_cosine;
      if (pushes && groupOf(pairs_[c]) == group) return true;
    }
    return false;
  };
  const bool has_way_out = isAnyPushing(*out, kOut);
  std::uint32_t deepest = kNone;
  for (const std::uint32_t c : members) {
    const Vec3& normal = contacts[c].normal;
    if (normal.dot(*out) >= kAcross || (has_way_out && !isAnyPushing(-normal, kOpposed))) continue;
    removed_[c] = Removed::pinches;
    if (deepest == kNone || contacts[c].distance < contacts[deepest].distance) deepest = c;
  }
  if (deepest == kNone) return;
  removed_[deepest] = Removed::no;
  Contact& contact = contacts[deepest];
  const double extent = curve_.extentAlong(*out);
  contact.normal = *out;
  contact.distance = has_way_out ? -extent : std::min(contact.distance, -extent);
  placeAround(curve_.middle(), contact);
}

/// Marks contacts whose triangles are apart, with one triangle on the back of the other, and that are
/// connected to contacts whose triangles meet.
void SurfaceContacts::markPast(const std::vector<Contact>& contacts) {
  const auto isApart = [](const Contact& contact) { return contact.distance > 0.0; };
  constexpr double kBehind = 1e-3;
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    if (!isApart(contact) || isApart(contacts[deepest_[groupOf(pairs_[c])]])) continue;
    const Vec3 facing_a = scaledNormal(surface_a_.triangle(pairs_[c].a)),
               facing_b = scaledNormal(surface_b_.triangle(pairs_[c].b));
    if (contact.normal.dot(facing_a) > kBehind * facing_a.norm() ||
        contact.normal.dot(facing_b) < -kBehind * facing_b.norm()) {
      removed_[c] = Removed::past;
    }
  }
}

void SurfaceContacts::markInner(const std::vector<Contact>& contacts) {
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    if (removed_[c] == Removed::no && (isInner(contacts, c, true) || isInner(contacts, c, false)))
      removed_[c] = Removed::inner;
  }
}

/// Whether a contact is at an angle to a body's triangle, at an edge or corner beyond which another triangle
/// of this body leans towards the other body, and comes nearer or meets it.
bool SurfaceContacts::isInner(const std::vector<Contact>& contacts, std::uint32_t c, bool of_a) const {
  const Contact& contact = contacts[c];
  const LocalSurface& surface = of_a ? surface_a_ : surface_b_;
  const std::uint32_t number = of_a ? pairs_[c].a : pairs_[c].b;
  const Triangle& own = surface.triangle(number);
  const Vec3 &point = of_a ? contact.point_on_a : contact.point_on_b,
             &opposite = of_a ? contact.point_on_b : contact.point_on_a;
  const Vec3 normal = scaledNormal(own);
  if (isPerpendicular(normal, contact.normal)) return false;
  const unsigned feature = featureOf(own, normal, point);
  if (feature == 0b111u || feature == 0) return false;
  const Vec3 towards = of_a ? Vec3(-contact.normal) : contact.normal;
  const Triangle& faced = of_a ? surface_b_.triangle(pairs_[c].b) : surface_a_.triangle(pairs_[c].a);
  const LocalSurface::Lean least = leanAt(isOnFace(scaledNormal(faced), -towards));
  if (contact.distance > 0.0) {
    const double limit =
        contact.distance - roundingOf(surface_a_.triangle(pairs_[c].a), surface_b_.triangle(pairs_[c].b));
    if (limit > 0.0) return surface.comesNearer(number, feature, point, opposite, limit, least);
  }
  return surface.leansBeyond(number, feature, towards, least, [&](std::uint32_t other) {
    TrianglePair pair = trianglesOf(contact);
    (of_a ? pair.a : pair.b) = surface.index(other);
    const auto found = std::ranges::lower_bound(contacts, pair, {}, trianglesOf);
    if (found == contacts.end() || trianglesOf(*found) != pair) return false;
    // A triangle that is wholly past the face is deeper than one that meets it.
    return found->distance <= 0.0 ||
           removed_[static_cast<std::size_t>(found - contacts.begin())] == Removed::past;
  });
}

}  // namespace octoblisk::detail
