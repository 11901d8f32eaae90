#include "octoblisk/internal_edges.h"

#include <algorithm>
#include <tuple>

#include "octoblisk/triangle_feature.h"

namespace octoblisk {
namespace {

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
    const auto [first, second] = endsOf(feature);
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
