#include "contact/way_back.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace octoblisk::detail {
namespace {

constexpr double kAlong = 0.3;  // a cosine; contacts within 17° of the surface push along it

/// Turns a contact to push A in a direction. A point on one of the surfaces stays.
void turn(Contact& contact, const Vec3& direction, double distance, bool is_surface_of_a) {
  contact.normal = direction;
  contact.distance = distance;
  if (is_surface_of_a) {
    contact.point_on_b = contact.point_on_a - distance * direction;
  } else {
    contact.point_on_a = contact.point_on_b + distance * direction;
  }
}

}  // namespace

void WayBack::pushBack(std::vector<Contact>& contacts, const Step& step, const std::optional<Vec3>& center,
                       FunctionRef<Normals(const Contact& contact)> normals_at) {
  if (!home_) {
    home_ = step.start;
    is_through_ = false;
  }
  is_new_ = false;
  const Pose to_home = *home_ * step.now.inverse();
  bool is_back = false;
  double deepest = std::numeric_limits<double>::infinity();
  Contact turned;  // the deepest of the removed contacts
  std::size_t kept = 0;
  const bool was_through = is_through_;
  for (const Contact& contact : contacts) {
    const Normals normals = normals_at(contact);
    const Vec3 of_a = normals.of_a.normalized(), of_b = normals.of_b.normalized();
    const bool is_of_a = std::abs(of_a.dot(contact.normal)) >= std::abs(of_b.dot(contact.normal));
    const Vec3& normal = is_of_a ? of_a : of_b;
    const Vec3& place = is_of_a ? contact.point_on_a : contact.point_on_b;
    const Vec3 now = center ? Vec3(step.now * *center) : place, at_home = to_home * now;
    const double height = normal.dot(at_home - place);
    const Vec3 out = std::copysign(1.0, -height) * normal;  // the direction of A
    const double cosine = out.dot(contact.normal);
    const bool is_known = height != 0.0 && ((center && was_through) || std::abs(cosine) > kAlong);
    if (!is_known || cosine > kAlong) {
      is_back |= is_known;
      contacts[kept++] = contact;
      continue;
    }
    is_through_ = true;
    if (!(contact.distance < deepest)) continue;
    deepest = contact.distance;
    turned = contact;
    turn(turned, out, std::min(0.0, out.dot(at_home - now)), is_of_a);
  }
  const bool removes = kept < contacts.size();
  contacts.resize(kept);
  if (kept == 0) contacts.push_back(turned);
  if (center && !removes && (is_back || !was_through)) home_.reset();
}

}  // namespace octoblisk::detail
