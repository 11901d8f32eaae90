#include "contact/way_back.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/surface_pair.h"

namespace octoblisk::detail {
namespace {

constexpr double kToSide = 0.5;  // a cosine; within 30° of the surface, a direction leads to neither side

}  // namespace

void WayBack::pushBack(std::vector<Contact>& contacts, const Pose& to_last,
                       FunctionRef<Normals(const Contact& contact)> normals_at) const {
  double deepest = std::numeric_limits<double>::infinity();
  Contact turned;  // the deepest of the removed contacts
  std::size_t kept = 0;
  for (const Contact& contact : contacts) {
    const std::optional<Way> way = wayAt(contact, normals_at(contact), to_last);
    if (!way || way->direction.dot(contact.normal) > kToSide) {
      contacts[kept++] = contact;
    } else if (contact.distance < deepest) {
      deepest = contact.distance;
      turned = contact;
      turned.normal = way->direction;
      turned.distance = way->distance;
    }
  }
  contacts.resize(kept);
  if (kept > 0) return;
  placeAround(0.5 * (turned.point_on_a + turned.point_on_b), turned);
  contacts.push_back(turned);
}

std::optional<WayBack::Way> WayBack::wayAt(const Contact& contact, const Normals& normals,
                                           const Pose& to_last) const {
  const Vec3 of_a = normals.of_a.normalized(), of_b = normals.of_b.normalized();
  const bool is_of_a = std::abs(of_a.dot(contact.normal)) >= std::abs(of_b.dot(contact.normal));
  const Vec3 normal = is_of_a ? of_a : of_b;
  const auto placeOf = [is_of_a](const Contact& c) { return is_of_a ? c.point_on_a : c.point_on_b; };
  const Vec3 place = placeOf(contact), last_place = to_last * place;
  const Vec3 motion = place - last_place;  // of B
  const auto wayTo = [&](double side, double last_distance) {
    const Vec3 direction = std::copysign(1.0, side) * normal;
    return Way{direction, std::min(0.0, std::min(0.0, last_distance) - motion.dot(direction))};
  };

  if (last_.empty()) {
    const double side = motion.dot(normal);
    if (!(std::abs(side) > kToSide * motion.norm())) return std::nullopt;
    return wayTo(side, 0.0);
  }
  const Vec3 last_on_surface = is_of_a ? place : last_place;
  const auto nearest = std::ranges::min_element(
      last_, {}, [&](const Contact& last) { return (placeOf(last) - last_on_surface).squaredNorm(); });
  const double side = nearest->normal.dot(is_of_a ? normal : Vec3(to_last.rotation * normal));
  if (!(std::abs(side) > kToSide)) return std::nullopt;
  return wayTo(side, nearest->distance);
}

}  // namespace octoblisk::detail
