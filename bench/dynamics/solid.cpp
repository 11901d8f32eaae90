#include "dynamics/solid.h"

#include <utility>

#include "octoblisk/mass_properties.h"

namespace octoblisk::bench {
namespace {

bool isPrincipal(const MassProperties& properties, double size) {
  const Mat3 products = properties.inertia - Mat3(properties.inertia.diagonal().asDiagonal());
  return properties.center_of_mass.norm() < 1e-9 * size && products.norm() < 1e-9 * size * size;
}

}  // namespace

shapes::SharedMesh inPrincipalFrame(const shapes::SharedMesh& mesh) {
  const MassProperties properties = massProperties(*mesh);
  if (isPrincipal(properties, mesh->bounds().halfExtents().norm())) return mesh;
  const Pose frame = principalFrame(properties).in_mesh.inverse();
  std::vector<Vec3> vertices = mesh->vertices();
  for (Vec3& vertex : vertices) vertex = frame * vertex;
  return std::make_shared<const TriangleMesh>(std::move(vertices), mesh->triangles());
}

Pieces piecesOfEight(std::size_t count, std::uint32_t first, std::uint32_t stride) {
  Pieces pieces(count);
  for (auto& piece : pieces) {
    for (std::uint32_t k = 0; k < 8; ++k) piece.push_back(first + k);
    first += stride;
  }
  return pieces;
}

Solid::Solid(shapes::SharedMesh closed, Pieces convex_pieces)
    : mesh(std::move(closed)),
      pieces(std::move(convex_pieces)),
      moments(massProperties(*mesh).inertia.diagonal()),
      tree(ClusteredOctree::build(mesh)),
      surface(tree) {}

}  // namespace octoblisk::bench
