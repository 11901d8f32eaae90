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

}  // namespace

void InternalEdges::removeFrom(std::vector<Contact>& contacts, const TriangleMesh& mesh) {
  if (contacts.size() < 2) return;
  places_.clear();
  places_.reserve(contacts.size());
  for (const Contact& contact : contacts) {
    const Triangle triangle = mesh.triangle(contact.triangle_a);
    const Vec3 normal = scaledNormal(triangle);
    places_.push_back({triangle, normal, featureOf(triangle, normal, contact.point_on_a),
                       isPerpendicular(normal, contact.normal)});
  }
  if (std::ranges::none_of(places_, &Place::isAskew)) return;

  corners_.clear();
  corners_.reserve(contacts.size());
  order_.resize(contacts.size());
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    corners_.addCorners(places_[c].triangle, c);
    order_[c] = c;
  }
  std::ranges::sort(order_, {}, [&](std::uint32_t c) { return std::tuple(contacts[c].distance, c); });
  is_internal_.assign(contacts.size(), 0);
  for (const std::uint32_t c : order_) {
    const Place& place = places_[c];
    if (!place.isAskew()) continue;
    const Triangle& triangle = place.triangle;
    const auto [first, second] = endsOf(place.feature);
    const Vec3 &from = triangle[first], &to = triangle[second];
    const double size = (triangle[1] - triangle[0]).norm() + (triangle[2] - triangle[0]).norm();
    is_internal_[c] = corners_.anyAt(from, [&](std::uint32_t other) {
      if (!(contacts[other].distance < contacts[c].distance - 1e-9 * size)) return false;
      const Place& shares = places_[other];
      if (is_internal_[other] == 0 && !shares.is_perpendicular) return false;
      if (!areSmooth(place.normal, shares.normal)) return false;
      if (!hasCorner(shares.triangle, from) || !hasCorner(shares.triangle, to)) return false;
      return leansOver(shares.triangle, from, to, -contacts[c].normal);
    });
  }
  std::size_t kept = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (is_internal_[c] == 0) contacts[kept++] = contacts[c];
  }
  contacts.resize(kept);
}

}  // namespace octoblisk::detail
