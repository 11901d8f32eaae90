#include "grinding/fixture.h"

#include <utility>

namespace octoblisk::demos {

BodyNames::BodyNames(int blade_count, std::span<const Fixture> fixtures) : blade_count_(blade_count) {
  for (const Fixture& fixture : fixtures) fixtures_.push_back(fixture.name);
}

std::string BodyNames::nameOf(int body) const {
  if (isFixture(body)) return cellOf(body);
  return body == 0 ? "hub or shroud" : "blade " + std::to_string(body);
}

std::string BodyNames::cellOf(int body) const {
  return isFixture(body) ? fixtures_[static_cast<std::size_t>(body - blade_count_ - 1)]
                         : std::to_string(body);
}

Surroundings surroundingsOf(const std::shared_ptr<const TriangleMesh>& blisk,
                            std::span<const int> blade_of_triangle, int blade_count,
                            std::span<const Fixture> fixtures) {
  Surroundings all{blisk, {blade_of_triangle.begin(), blade_of_triangle.end()}};
  if (fixtures.empty()) return all;
  std::vector<Vec3> vertices(blisk->vertices().begin(), blisk->vertices().end());
  std::vector<TriangleMesh::Indices> triangles(blisk->triangles().begin(), blisk->triangles().end());
  int body = blade_count;
  for (const Fixture& fixture : fixtures) {
    const TriangleMesh& mesh = fixture.tree->mesh();
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), mesh.vertices().begin(), mesh.vertices().end());
    for (const TriangleMesh::Indices& corners : mesh.triangles()) {
      triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
    }
    all.body_of_triangle.resize(triangles.size(), ++body);
  }
  all.mesh = std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
  return all;
}

}  // namespace octoblisk::demos
