#include "contact/surface_contacts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/triangle_feature.h"
#include "geometry/triangle_pair.h"
#include "query/near_pairs.h"
#include "tree/tree.h"

namespace octoblisk::detail {
namespace {

/// Appends a contact for each other corner of a triangle that is over the face on which its contact pushes. A
/// triangle has one contact, at its nearest point, but may lie on the face.
void addCorners(std::vector<PairedContact>& contacts, const SurfacePair& surfaces, double threshold) {
  const std::size_t count = contacts.size();
  for (std::size_t c = 0; c < count; ++c) {
    const PairedContact of_pair = contacts[c];
    const auto addCornersOf = [&](const SurfaceSide& own, const SurfaceSide& opposite) {
      if (!opposite.isPushedBy(of_pair)) return;
      const Triangle& face = opposite.triangle(of_pair.pair);
      const Vec3& facing = opposite.facing(of_pair.pair);
      // Heights along the contact's normal would be wrong far from face[0].
      const Vec3 outward = facing.normalized();
      for (const Vec3& corner : own.triangle(of_pair.pair)) {
        const double height = outward.dot(corner - face[0]);
        if (!(height <= threshold) || !isOver(face, facing, corner)) continue;
        if ((corner - of_pair.*own.point).norm() <= surfaces.roundingOf(of_pair.pair)) continue;
        PairedContact contact = of_pair;
        contact.*own.point = corner;
        contact.*opposite.point = corner - height * outward;
        contact.normal = opposite.outward * outward;
        contact.distance = height;
        contacts.push_back(contact);
      }
    };
    addCornersOf(surfaces.a, surfaces.b);
    addCornersOf(surfaces.b, surfaces.a);
  }
}

/// Contacts of edges and corners between nearly parallel faces have slightly tilted normals. A normal within
/// this tilt of the perpendicular to one of the two faces becomes that perpendicular. The middle between the
/// points stays, and so does the distance.
void alignWithFaces(std::vector<PairedContact>& contacts, const SurfacePair& surfaces) {
  constexpr double kAlong = 1.0 - 0.5 * kSlightTilt * kSlightTilt;  // the cosine
  for (PairedContact& contact : contacts) {
    Vec3& normal = contact.normal;
    if (surfaces.a.isPerpendicularTo(contact) || surfaces.b.isPerpendicularTo(contact)) continue;
    const Vec3 &of_a = surfaces.a.facing(contact.pair), &of_b = surfaces.b.facing(contact.pair);
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
    contact.point_on_a = middle + 0.5 * contact.distance * contact.normal;
    contact.point_on_b = middle - 0.5 * contact.distance * contact.normal;
  }
}

}  // namespace

void SurfaceContacts::clear() {
  surfaces_.clear();
  contacts_.clear();
  skipped_.clear();
}

void SurfaceContacts::find(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a,
                           double threshold, double surplus, std::vector<Contact>& found) {
  clear();
  of_near_.clear();
  threshold = nearPairs(treeOf(a), treeOf(b), b_in_a, threshold, surplus, near_);
  bool meet = false;
  for (NearPair& near : near_) {
    const TrianglePair of = near.triangles;
    const NumberPair pair = {surfaces_.a.surface.add(of.a, [&] { return a.mesh().triangle(of.a); }),
                             surfaces_.b.surface.add(of.b, [&] { return b_in_a * b.mesh().triangle(of.b); })};
    of_near_.push_back(pair);
    if (near.meeting == Meeting::maybe) {
      near.meeting =
          intersects(surfaces_.a.triangle(pair), surfaces_.b.triangle(pair)) ? Meeting::yes : Meeting::no;
    }
    meet = meet || near.meeting == Meeting::yes;
  }
  if (meet) findMeetingGroups();
  wanted_.clear();
  for (std::uint32_t n = 0; n < near_.size(); ++n) {
    const bool group_meets = meet && meets_[groups_.groupOf(of_near_[n])];
    if (isSurelyInner(surfaces_, of_near_[n], near_[n].features, threshold, group_meets)) {
      skipped_.push_back(of_near_[n]);
    } else {
      wanted_.push_back(n);
    }
  }
  std::ranges::sort(wanted_, {}, [&](std::uint32_t n) { return near_[n].triangles; });
  for (const std::uint32_t n : wanted_) {
    const NumberPair& pair = of_near_[n];
    const std::optional<Contact> contact =
        contactWithin(threshold, near_[n], surfaces_.a.triangle(pair), surfaces_.b.triangle(pair));
    if (contact) contacts_.push_back({*contact, pair});
  }
  filter(threshold);
  found.assign(contacts_.begin(), contacts_.end());
}

/// Finds the groups of near pairs in which triangles meet.
void SurfaceContacts::findMeetingGroups() {
  groups_.reset(surfaces_);
  groups_.add(of_near_);
  meets_.assign(groups_.size(), false);
  for (std::size_t n = 0; n < near_.size(); ++n) {
    if (near_[n].meeting == Meeting::yes) meets_[groups_.groupOf(of_near_[n])] = true;
  }
}

void SurfaceContacts::filter(double threshold) {
  if (!contacts_.empty() && contacts_.size() + skipped_.size() >= 2) {
    long_ways_.removeFrom(contacts_, surfaces_);  // first, because their depths are meaningless
    inner_contacts_.removeFrom(contacts_, surfaces_, skipped_);
    alignWithFaces(contacts_, surfaces_);
  }
  addCorners(contacts_, surfaces_, threshold);
}

}  // namespace octoblisk::detail
