#include "contact/internal_edges.h"

#include <algorithm>
#include <tuple>

#include "geometry/triangle_feature.h"

namespace octoblisk::detail {
namespace {

/// Whether a surface continues from one triangle to the other without a ridge.
bool areSmooth(const Vec3& normal_a, const Vec3& normal_b) {
  constexpr double kSmooth = 0.94;  // the cosine of 20°
  return normal_a.dot(normal_b) > kSmooth * normal_a.norm() * normal_b.norm();
}

auto asTuple(const Vec3& position) { return std::tuple(position.x(), position.y(), position.z()); }

bool hasCorner(const Triangle& triangle, const Vec3& position) {
  return std::ranges::find(triangle, position) != triangle.end();
}

}  // namespace

void InternalEdges::removeFrom(std::vector<Contact>& contacts, const TriangleMesh& mesh) {
  constexpr double kLean = 1e-3;  // a sine
  const auto byPosition = [](const Corner& corner) { return asTuple(corner.position); };
  if (contacts.size() < 2) return;
  places_.clear();
  places_.reserve(contacts.size());
  at_an_angle_.clear();
  at_an_angle_.reserve(contacts.size());
  for (const Contact& contact : contacts) {
    const Triangle triangle = mesh.triangle(contact.triangle_a);
    const Vec3 normal = scaledNormal(triangle);
    const bool is_perpendicular = isPerpendicular(normal, contact.normal);
    const unsigned feature = is_perpendicular ? kFace : featureOf(triangle, normal, contact.point_on_a);
    if (feature != kFace && feature != 0) at_an_angle_.push_back(static_cast<std::uint32_t>(places_.size()));
    places_.push_back({triangle, normal, feature, is_perpendicular, false});
  }
  if (at_an_angle_.empty()) return;

  corners_.clear();
  for (std::uint32_t c = 0; c < places_.size(); ++c) {
    for (const Vec3& corner : places_[c].triangle) corners_.push_back({corner, c});
  }
  std::ranges::sort(corners_, {}, byPosition);
  std::ranges::sort(at_an_angle_, {}, [&](std::uint32_t c) { return std::tuple(contacts[c].distance, c); });
  for (const std::uint32_t c : at_an_angle_) {
    Place& place = places_[c];
    const Triangle& triangle = place.triangle;
    const auto [first, second] = endsOf(place.feature);
    const Vec3 &from = triangle[first], &to = triangle[second];
    const double size = (triangle[1] - triangle[0]).norm() + (triangle[2] - triangle[0]).norm();
    const auto at_from = std::ranges::equal_range(corners_, asTuple(from), {}, byPosition);
    place.is_internal = std::ranges::any_of(at_from, [&](const Corner& corner) {
      const std::uint32_t other = corner.contact;
      if (!(contacts[other].distance < contacts[c].distance - 1e-9 * size)) return false;
      const Place& shares = places_[other];
      if (!shares.is_internal && !shares.is_perpendicular) return false;
      if (!shares.is_perpendicular && !areSmooth(place.normal, shares.normal)) return false;
      if (!hasCorner(shares.triangle, from) || !hasCorner(shares.triangle, to)) return false;
      return sineOfLean(shares.triangle, from, to, -contacts[c].normal) > kLean;
    });
  }
  std::size_t kept = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!places_[c].is_internal) contacts[kept++] = contacts[c];
  }
  contacts.resize(kept);
}

}  // namespace octoblisk::detail
