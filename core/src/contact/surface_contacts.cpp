#include "contact/surface_contacts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/triangle_feature.h"
#include "geometry/triangle_pair.h"
#include "query/by_triangles.h"
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

/// Whether two triangles are nearer than `distance`, which is above 0.
bool areWithin(double distance, const Triangle& a, const Triangle& b) {
  const auto isOfB = [&](const Vec3& corner) { return hasCorner(b, corner); };
  return std::ranges::any_of(a, isOfB) || contactOf(a, b).distance < distance;
}

/// Places the points of a contact at its distance along its normal.
void placeAround(const Vec3& middle, Contact& contact) {
  contact.point_on_a = middle + 0.5 * contact.distance * contact.normal;
  contact.point_on_b = middle - 0.5 * contact.distance * contact.normal;
}

}  // namespace

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
  a_.surface.clear();
  b_.surface.clear();
  pairs_.clear();
  skipped_.clear();
  meeting_.clear();
}

void SurfaceContacts::find(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a,
                           double threshold, double surplus, std::vector<Contact>& found) {
  found.clear();
  clear();
  threshold = nearPairs(treeOf(a), treeOf(b), b_in_a, threshold, surplus, near_);
  bool meet = false;
  for (NearPair& near : near_) {
    const TrianglePair of = near.triangles;
    const Pair pair = {a_.surface.add(of.a, [&] { return a.mesh().triangle(of.a); }),
                       b_.surface.add(of.b, [&] { return b_in_a * b.mesh().triangle(of.b); })};
    pairs_.push_back(pair);
    if (near.meeting == Meeting::maybe) {
      near.meeting = intersects(a_.triangle(pair), b_.triangle(pair)) ? Meeting::yes : Meeting::no;
    }
    meet = meet || near.meeting == Meeting::yes;
  }
  if (meet) findMeetingGroups();
  wanted_.clear();
  for (std::uint32_t n = 0; n < near_.size(); ++n) {
    const bool group_meets = meet && meets_[groupOf(pairs_[n])];
    if (isSurelyInner(near_[n].features, pairs_[n], threshold, group_meets)) {
      skipped_.push_back(pairs_[n]);
    } else {
      wanted_.push_back(n);
    }
  }
  std::ranges::sort(wanted_, {}, [&](std::uint32_t n) { return near_[n].triangles; });
  of_contacts_.clear();
  for (const std::uint32_t n : wanted_) {
    const Pair& pair = pairs_[n];
    const std::optional<Contact> contact =
        contactWithin(threshold, near_[n], a_.triangle(pair), b_.triangle(pair));
    if (!contact) continue;
    found.push_back(*contact);
    of_contacts_.push_back(pair);
  }
  pairs_.assign(of_contacts_.begin(), of_contacts_.end());
  filter(found, threshold);
}

/// Finds the groups of near pairs in which triangles meet.
void SurfaceContacts::findMeetingGroups() {
  findGroups({&pairs_});
  meets_.assign(groups_.size(), false);
  for (std::size_t n = 0; n < near_.size(); ++n) {
    if (near_[n].meeting == Meeting::yes) meets_[groupOf(pairs_[n])] = true;
  }
}

/// Whether two triangles that do not meet are surely within the threshold, and the surface of one of them
/// surely comes nearer beyond the edge or corner where they are closest. In a group that meets, false unless
/// both triangles surely face each other there, because contacts past a face decide about others (isInner).
bool SurfaceContacts::isSurelyInner(const ClosestFeatures& features, const Pair& pair, double threshold,
                                    bool group_meets) const {
  if (!features.areKnown()) return false;
  const Triangle &a = a_.triangle(pair), &b = b_.triangle(pair);
  const auto places = features.places(a, b);
  const PlaceOnTriangle &on_a = places.first, &on_b = places.second;
  const auto isOn = [&](const PlaceOnTriangle& place, const Side& side) {
    return place.feature != 0b111u || isOver(side.triangle(pair), side.facing(pair), place.point);
  };
  if (!isOn(on_a, a_) || !isOn(on_b, b_)) return false;  // single precision was wrong
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
  const double limit = least - roundingOf(pair);
  if (!(limit > 0.0)) return false;
  const auto isSurelyTilted = [&](const Side& side) {
    const Vec3& facing = side.facing(pair);
    const double tilt = kParallelSine + error;
    return facing.cross(way).squaredNorm() > tilt * tilt * squared * facing.squaredNorm();
  };
  const auto isSurelyInFrontOf = [&](const Side& side) {
    const Vec3& facing = side.facing(pair);
    return -side.outward * way.dot(facing) > error * length * facing.norm();
  };
  if (group_meets && !(isSurelyInFrontOf(a_) && isSurelyInFrontOf(b_))) return false;
  const auto surfaceComesNearer = [&](const Side& own, const PlaceOnTriangle& at, const Side& opposite,
                                      const PlaceOnTriangle& opposite_at) {
    if (at.feature == 0b111u || !isSurelyTilted(own)) return false;
    return own.surface.comesNearer(pair.*own.number, at.feature, at.point, opposite_at.point, limit,
                                   leanAt(!isSurelyTilted(opposite), error));
  };
  return surfaceComesNearer(a_, on_a, b_, on_b) || surfaceComesNearer(b_, on_b, a_, on_a);
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
    const Contact of_pair = contacts[c];
    const Pair pair = pairs_[c];
    const auto addCornersOf = [&](const Side& own, const Side& opposite) {
      if (!opposite.isPushedBy(of_pair, pair)) return;
      const Triangle& face = opposite.triangle(pair);
      const Vec3& facing = opposite.facing(pair);
      // Heights along the contact's normal would be wrong far from face[0].
      const Vec3 outward = facing.normalized();
      for (const Vec3& corner : own.triangle(pair)) {
        const double height = outward.dot(corner - face[0]);
        if (!(height <= threshold) || !isOver(face, facing, corner)) continue;
        if ((corner - of_pair.*own.point).norm() <= roundingOf(pair)) continue;
        Contact contact = of_pair;
        contact.*own.point = corner;
        contact.*opposite.point = corner - height * outward;
        contact.normal = opposite.outward * outward;
        contact.distance = height;
        contacts.push_back(contact);
        pairs_.push_back(pair);
      }
    };
    addCornersOf(a_, b_);
    addCornersOf(b_, a_);
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
    if (a_.isPerpendicularTo(contact, pairs_[c]) || b_.isPerpendicularTo(contact, pairs_[c])) continue;
    const Vec3 &of_a = a_.facing(pairs_[c]), &of_b = b_.facing(pairs_[c]);
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
  const auto markWaysOutOf = [&](const Side& own, const Side& opposite) {
    sortByTriangle(opposite);
    for (std::size_t number = 0; number < opposite.surface.size(); ++number) {
      const Members opposite_one =
          Members(by_triangle_).subspan(first_[number], first_[number + 1] - first_[number]);
      markLongWays(contacts, opposite_one, own, opposite);
    }
  };
  markWaysOutOf(a_, b_);
  markWaysOutOf(b_, a_);
  dropRemoved(contacts);
  removed_.assign(contacts.size(), Removed::no);
}

/// Lists the contacts of each triangle of one side in by_triangle_, from first_[number] to first_[number +
/// 1].
void SurfaceContacts::sortByTriangle(const Side& side) {
  first_.assign(side.surface.size() + 2, 0);
  for (const Pair& pair : pairs_) ++first_[pair.*side.number + 2];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  by_triangle_.resize(pairs_.size());
  for (std::uint32_t c = 0; c < pairs_.size(); ++c) by_triangle_[first_[pairs_[c].*side.number + 1]++] = c;
}

/// Marks contacts with one triangle of the other body that are perpendicular to a face of this body although
/// another face of this body meets the triangle far less deep. The two faces must be below each other's
/// planes, and the other face
/// - is near the triangle's deepest point, or
/// - is near the first face, while the deepest point is outside the body, over that other face or a third
///   one.
void SurfaceContacts::markLongWays(const std::vector<Contact>& contacts, Members opposite_one,
                                   const Side& own, const Side& opposite) {
  if (opposite_one.size() < 2) return;
  faces_.clear();
  for (const std::uint32_t c : opposite_one) {
    const Contact& contact = contacts[c];
    if (!(contact.distance < 0.0) || !own.isPerpendicularTo(contact, pairs_[c])) continue;
    if (faces_.empty()) findFaces(contacts, opposite_one, own);
    const Face face = {own.triangle(pairs_[c]), own.facing(pairs_[c]).normalized(), contact.distance};
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
    if (std::ranges::any_of(faces_, isShortWay)) removed_[c] = Removed::long_way;
  }
}

/// Collects faces that meet a triangle, from the least deep contacts. Their number is limited, so that a
/// large triangle under a fine mesh does not take quadratic time.
void SurfaceContacts::findFaces(const std::vector<Contact>& contacts, Members opposite_one, const Side& own) {
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
    faces_.push_back({own.triangle(pairs_[c]), own.facing(pairs_[c]).normalized(), contacts[c].distance});
  }
}

/// Groups pairs that are connected by triangles.
void SurfaceContacts::findGroups(std::initializer_list<const std::vector<Pair>*> of) {
  groups_.reset(a_.surface.size() + b_.surface.size());
  for (const std::vector<Pair>* const pairs : of) {
    for (const Pair& pair : *pairs) groups_.join(a_.surface.size() + pair.b, pair.a);
  }
}

/// Finds the deepest contact of each group.
void SurfaceContacts::findDeepest(const std::vector<Contact>& contacts) {
  deepest_.assign(groups_.size(), kNoIndex);
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    std::uint32_t& deepest = deepest_[groupOf(pairs_[c])];
    if (deepest == kNoIndex || contacts[c].distance < contacts[deepest].distance) deepest = c;
  }
}

/// Restores the deepest contact of each group that was removed entirely, and the deepest contact of all.
void SurfaceContacts::keepDeepest(const std::vector<Contact>& contacts) {
  const auto deepest = std::ranges::min_element(contacts, {}, &Contact::distance) - contacts.begin();
  removed_[static_cast<std::size_t>(deepest)] = Removed::no;
  stays_.assign(groups_.size(), false);
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    if (removed_[c] == Removed::no) stays_[groupOf(pairs_[c])] = true;
  }
  for (std::uint32_t root = 0; root < groups_.size(); ++root) {
    if (deepest_[root] != kNoIndex && !stays_[root]) removed_[deepest_[root]] = Removed::no;
  }
}

/// Whether two triangles face each other along their contact, as at the wall of a hole, not where one body
/// crosses the other.
bool SurfaceContacts::areFacing(const Contact& contact, const Pair& pair) const {
  constexpr double kFacing = 0.55;  // a cosine; of the faces at a box's corner, one has at least 0.577
  const Vec3 &of_a = a_.facing(pair), &of_b = b_.facing(pair);
  return of_a.dot(contact.normal) < -kFacing * of_a.norm() &&
         of_b.dot(contact.normal) > kFacing * of_b.norm();
}

void SurfaceContacts::openPinches(std::vector<Contact>& contacts) {
  pinching_.clear();
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].distance <= 0.0 && !areFacing(contacts[c], pairs_[c])) pinching_.push_back(c);
  }
  if (pinching_.empty()) return;
  curve_.clear();
  of_segments_.clear();
  for (const Pair& pair : meeting_) {
    if (const std::optional<CurveSegment> segment = meetingSegment(a_.triangle(pair), b_.triangle(pair))) {
      curve_.push_back(*segment);
      of_segments_.push_back(pair);
    }
  }
  if (!wayOut(curve_)) return;  // one body may pierce the other
  removed_.assign(contacts.size(), Removed::no);
  findGroups({&meeting_});
  std::ranges::sort(pinching_, {}, [&](std::uint32_t c) { return std::pair(groupOf(pairs_[c]), c); });
  for (auto first = pinching_.begin(); first != pinching_.end();) {
    const std::uint32_t group = groupOf(pairs_[*first]);
    const auto last =
        std::find_if(first, pinching_.end(), [&](std::uint32_t c) { return groupOf(pairs_[c]) != group; });
    openPinch(contacts, {first, last}, group);
    first = last;
  }
  dropRemoved(contacts);
}

/// Opens one crossing: a group of pairs that meet. The members are its contacts that may pinch. Where bars
/// cross, the curve extends as far as they overlap. An end that pokes into a side has a flat curve: without
/// another way out, the depth is that of the triangles. The curve of surfaces that lie along each other, as
/// the walls of nested cups do, extends much farther than they overlap: their contacts stay as they are.
void SurfaceContacts::openPinch(std::vector<Contact>& contacts, Members members, std::uint32_t group) {
  crossing_.clear();
  for (std::size_t s = 0; s < curve_.size(); ++s) {
    if (groupOf(of_segments_[s]) == group) crossing_.push_back(curve_[s]);
  }
  const std::optional<Vec3> out = wayOut(crossing_);
  if (!out) return;
  constexpr double kOpposed = 0.9, kAcross = 0.5, kOut = 0.2;  // cosines
  constexpr double kCrossing = 0.25;  // the least depth as a fraction of the extent; bars that cross have 1
  const double extent = extentAlong(*out, crossing_);
  if (depthAlong(*out, crossing_) < kCrossing * extent) return;
  const auto isAnyPushing = [&](const Vec3& direction, double least_cosine) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const bool pushes = contacts[c].distance <= 0.0 && contacts[c].normal.dot(direction) > least_cosine;
      if (pushes && groupOf(pairs_[c]) == group) return true;
    }
    return false;
  };
  const bool has_way_out = isAnyPushing(*out, kOut);
  std::uint32_t deepest = kNoIndex;
  for (const std::uint32_t c : members) {
    const Vec3& normal = contacts[c].normal;
    if (normal.dot(*out) >= kAcross || (has_way_out && !isAnyPushing(-normal, kOpposed))) continue;
    removed_[c] = Removed::pinches;
    if (deepest == kNoIndex || contacts[c].distance < contacts[deepest].distance) deepest = c;
  }
  if (deepest == kNoIndex) return;
  removed_[deepest] = Removed::no;
  Contact& contact = contacts[deepest];
  contact.normal = *out;
  contact.distance = has_way_out ? -extent : std::min(contact.distance, -extent);
  placeAround(middleOf(crossing_), contact);
}

/// Marks contacts whose triangles are apart, with one triangle on the back of the other, and that are
/// connected to contacts whose triangles meet.
void SurfaceContacts::markPast(const std::vector<Contact>& contacts) {
  const auto isApart = [](const Contact& contact) { return contact.distance > 0.0; };
  constexpr double kBehind = 1e-3;
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    if (!isApart(contact) || isApart(contacts[deepest_[groupOf(pairs_[c])]])) continue;
    const auto isOnBack = [&](const Side& side) {
      const Vec3& facing = side.facing(pairs_[c]);
      return side.outward * contact.normal.dot(facing) < -kBehind * facing.norm();
    };
    if (isOnBack(a_) || isOnBack(b_)) removed_[c] = Removed::past;
  }
}

void SurfaceContacts::markInner(const std::vector<Contact>& contacts) {
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    if (removed_[c] == Removed::no && (isInner(contacts, c, a_, b_) || isInner(contacts, c, b_, a_)))
      removed_[c] = Removed::inner;
  }
}

/// Whether a contact is at an angle to a body's triangle, at an edge or corner beyond which another triangle
/// of this body leans towards the other body, and comes nearer or meets it.
bool SurfaceContacts::isInner(const std::vector<Contact>& contacts, std::uint32_t c, const Side& own,
                              const Side& opposite) const {
  const Contact& contact = contacts[c];
  const Pair& pair = pairs_[c];
  if (own.isPerpendicularTo(contact, pair)) return false;
  const Vec3 &point = contact.*own.point, &opposite_point = contact.*opposite.point;
  const unsigned feature = featureOf(own.triangle(pair), own.facing(pair), point);
  if (feature == 0b111u || feature == 0) return false;
  const std::uint32_t number = pair.*own.number;
  const LocalSurface::Lean least = leanAt(opposite.isPushedBy(contact, pair));
  if (contact.distance > 0.0) {
    const double limit = contact.distance - roundingOf(pair);
    if (limit > 0.0) return own.surface.comesNearer(number, feature, point, opposite_point, limit, least);
  }
  const Vec3 towards = own.outward * contact.normal;
  return own.surface.leansBeyond(number, feature, towards, least, [&](std::uint32_t other) {
    Contact sought = contact;
    sought.*own.index = own.surface.index(other);
    const auto found = std::ranges::lower_bound(contacts, sought.triangles(), {}, byTriangles);
    if (found == contacts.end() || found->triangles() != sought.triangles()) return false;
    // A triangle that is wholly past the face is deeper than one that meets it.
    return found->distance <= 0.0 ||
           removed_[static_cast<std::size_t>(found - contacts.begin())] == Removed::past;
  });
}

}  // namespace octoblisk::detail
