#include "contact/way_back.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/thin_triangle.h"

namespace octoblisk::detail {
namespace {

constexpr double kAlong = 0.3;  // a cosine; contacts within 17° of the surface push along it

/// Zero if there is no triangle, or if it is too thin for its normal.
Vec3 reliableNormal(const std::optional<Triangle>& triangle) {
  return triangle && !isThin(*triangle) ? unitNormal(*triangle) : Vec3(Vec3::Zero());
}

/// Makes a contact push A along a direction. The point on the open surface stays.
Contact turnedRound(Contact contact, const Vec3& direction, double distance) {
  contact.normal = direction;
  contact.distance = distance;
  contact.point_on_b = contact.point_on_a - distance * direction;
  return contact;
}

}  // namespace

/// Adds contacts of the feet that are past an open surface of A, on which B stands if it is pushed along a
/// unit vector.
void WayBack::addFeet(const ConvexBody& body, const Pose& now, const Vec3& towards, FindCrossing crossing,
                      std::vector<Contact>& contacts) const {
  const Vec3 before = reference_ * body.middle;
  for (const Vec3& point : body.feet(now.rotation.transpose() * towards)) {
    const Vec3 foot = now * point;
    const auto hit = crossing(before, foot + body.radius * towards);
    if (!hit) continue;
    const Vec3 normal = hit->back_face ? hit->normal : Vec3(-hit->normal);  // away from where B was
    const double height = normal.dot(hit->point - foot);
    // Another surface on the way, whose plane the foot has not crossed.
    if (-height > (foot - reference_ * point).norm() + body.radius) continue;
    contacts.push_back({foot + height * normal, foot + body.radius * normal, normal, height - body.radius,
                        hit->triangle, kNoTriangle});
  }
}

void WayBack::pushBack(std::vector<Contact>& contacts, const Pose& b_in_a, const ConvexBody& b,
                       FunctionRef<std::optional<Triangle>(const Contact& contact)> open_triangle,
                       FindCrossing crossing) {
  if (state_ == State::unknown) return;
  const bool was_through = state_ == State::through;
  const Vec3 before = reference_ * b.middle, way = before - b_in_a * b.middle;
  bool pushes_back = false, overlaps = false;
  Vec3 away = Vec3::Zero();  // the way that A should go, at the last contact that does not push B back
  Contact turned;            // the deepest of the removed contacts
  double deepest = std::numeric_limits<double>::infinity();
  std::size_t kept = 0;
  for (const Contact& contact : contacts) {
    const Vec3 normal = reliableNormal(open_triangle(contact));
    const double height = normal.dot(before - contact.point_on_a);
    const Vec3 out = std::copysign(1.0, -height) * normal;  // the way that A should go
    const double cosine = out.dot(contact.normal);
    // A contact that does not overlap shows a side only if the body has moved farther than it is away.
    const bool has_side = std::abs(height) > std::max(0.0, contact.distance);
    if (has_side && !(cosine > kAlong)) away = out;
    const bool is_known = has_side && (was_through || std::abs(cosine) > kAlong);
    if (is_known && !(cosine > kAlong)) {
      state_ = State::through;
      if (contact.distance >= deepest) continue;
      deepest = contact.distance;
      turned = turnedRound(contact, out, std::min(0.0, out.dot(way)));
    } else {
      pushes_back |= is_known;
      overlaps |= contact.distance <= 0.0;
      contacts[kept++] = contact;
    }
  }
  const bool removes = kept < contacts.size();
  contacts.resize(kept);
  if (!away.isZero(0.0)) addFeet(b, b_in_a, away, crossing, contacts);
  const bool has_feet = contacts.size() > kept;
  if (has_feet) state_ = State::through;
  if (!removes && !has_feet && (pushes_back || !was_through)) state_ = State::apart;
  if (removes && !overlaps && !has_feet) contacts.push_back(turned);
}

}  // namespace octoblisk::detail
