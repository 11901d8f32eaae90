#include "octoblisk/internal_edges.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <tuple>

namespace octoblisk {
namespace {

/// The corners of the edge that a point of a triangle is on, or the one corner that it is at: bit v for
/// corner v. All three for a point inside.
unsigned featureOf(const Triangle& triangle, const Vec3& point) {
  constexpr double kOn = 1e-6;  // of the triangle's size
  unsigned feature = 0;
  const Vec3 normal = scaledNormal(triangle);
  for (std::size_t v = 0; v < 3; ++v) {
    const Vec3 &from = triangle[(v + 1) % 3], &to = triangle[(v + 2) % 3];
    const double weight = normal.dot((to - from).cross(point - from));
    if (weight > kOn * normal.squaredNorm()) feature |= 1u << v;
  }
  return feature;
}

/// Whether the contact pushes square to the triangle's own face.
bool isSquare(const Triangle& triangle, const Vec3& normal) {
  constexpr double kSameDirection = 1.0 - 1e-6;
  const Vec3 facing = scaledNormal(triangle);
  return std::abs(facing.dot(normal)) >= kSameDirection * facing.norm();
}

/// Whether a direction from an edge, or a corner (both ends alike), leans over a triangle that has it.
bool leansOver(const Triangle& triangle, const Vec3& from, const Vec3& to, const Vec3& direction) {
  constexpr double kLean = 1e-3;
  const Vec3 edge = to - from;
  for (const Vec3& corner : triangle) {
    Vec3 inward = corner - from;
    if (edge.squaredNorm() > 0.0) inward -= edge * (edge.dot(inward) / edge.squaredNorm());
    if (direction.dot(inward) > kLean * inward.norm()) return true;
  }
  return false;
}

auto byPosition(const Vec3& p) { return std::tuple(p.x(), p.y(), p.z()); }

}  // namespace

void InternalEdges::removeFrom(std::vector<Contact>& contacts, const TriangleMesh& mesh) {
  if (contacts.size() < 2) return;
  corners_.clear();
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    for (const Vec3& corner : mesh.triangle(contacts[c].triangle_a)) corners_.push_back({corner, c});
  }
  std::ranges::sort(corners_, {},
                    [](const Corner& c) { return std::tuple(byPosition(c.position), c.contact); });
  const auto around = [&](const Vec3& position) {
    return std::ranges::equal_range(corners_, byPosition(position), {},
                                    [](const Corner& c) { return byPosition(c.position); });
  };
  const auto isAround = [&](std::uint32_t contact, const Vec3& position) {
    const auto corners = around(position);
    return std::ranges::binary_search(corners, contact, {}, &Corner::contact);
  };

  is_internal_.assign(contacts.size(), 0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Triangle triangle = mesh.triangle(contacts[c].triangle_a);
    const unsigned feature = featureOf(triangle, contacts[c].point_on_a);
    if (feature == 0b111u || feature == 0 || isSquare(triangle, contacts[c].normal)) continue;
    const auto first = static_cast<std::size_t>(std::countr_zero(feature));
    const auto second = static_cast<std::size_t>(31 - std::countl_zero(feature));
    const double size = (triangle[1] - triangle[0]).norm() + (triangle[2] - triangle[0]).norm();
    for (const Corner& other : around(triangle[first])) {
      if (!(contacts[other.contact].distance < contacts[c].distance - 1e-9 * size)) continue;
      if (second != first && !isAround(other.contact, triangle[second])) continue;
      const Triangle shares = mesh.triangle(contacts[other.contact].triangle_a);
      if (!leansOver(shares, triangle[first], triangle[second], -contacts[c].normal)) continue;
      is_internal_[c] = 1;
      break;
    }
  }
  std::size_t kept = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (is_internal_[c] == 0) contacts[kept++] = contacts[c];
  }
  contacts.resize(kept);
}

}  // namespace octoblisk
