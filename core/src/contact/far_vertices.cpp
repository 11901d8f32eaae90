#include "contact/far_vertices.h"

#include <algorithm>
#include <optional>

#include "contact/way_out_of_solid.h"
#include "octoblisk/closest_point.h"
#include "query/farthest_vertex.h"

namespace octoblisk::detail {

FarVertices farVertices(const ClusteredOctree& tree) {
  FarVertices far;
  std::size_t count = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vec3 direction(x, y, z);
        const double axes = direction.squaredNorm();
        if (axes == 1.0 || axes == 3.0) far.positions[count++] = farthestVertex(tree, direction);
      }
    }
  }
  return far;
}

void FarVerticesInSolid::find(const SolidMesh& solid_a, const ClusteredOctree& b, const FarVertices& far_of_b,
                              const Pose& b_in_a, bool meet, double least_depth,
                              std::vector<Contact>& ways_out) {
  ways_out.clear();
  const ClusteredOctree& a = solid_a.boundary();
  const auto add = [&](Contact out) {
    out.triangle_b = closestPoint(b, b_in_a.inverse() * out.point_on_b)->triangle;
    ways_out.push_back(out);
  };
  const auto forEachInside = [&](auto&& visit) {
    for (std::size_t v = 0; v < in_a_.size(); ++v) {
      const Vec3 vertex = b_in_a * far_of_b.positions[v];
      if (in_a_[v].contains(solid_a, vertex)) visit(vertex);
    }
  };
  if (meet) {
    forEachInside([&](const Vec3& vertex) {
      const Contact out = wayOutOfSolid(a, vertex, [&](const Vec3&) { return vertex; });
      if (out.distance < -least_depth) add(out);
    });
    return;
  }
  std::optional<Contact> of_all;  // the way out of all of B
  const auto findWayOfAll = [&](const Vec3& inside) {
    of_all = wayOutOfSolid(a, inside, [&](const Vec3& direction) -> Vec3 {
      return b_in_a * farthestVertex(b, b_in_a.rotation.transpose() * direction);
    });
  };
  const auto addWayOfAll = [&](const Vec3& point_on_b) {
    Contact out = *of_all;
    out.distance = (out.point_on_a - point_on_b).dot(out.normal);
    const bool is_known = std::ranges::find(ways_out, point_on_b, &Contact::point_on_b) != ways_out.end();
    if (!(out.distance < 0.0) || is_known) return;
    out.point_on_a = point_on_b + out.distance * out.normal;
    out.point_on_b = point_on_b;
    out.triangle_a = closestPoint(a, out.point_on_a)->triangle;
    add(out);
  };
  forEachInside([&](const Vec3& vertex) {
    if (!of_all) {
      const Vec3 middle = b_in_a * b.mesh().bounds().center();
      if (solid_a.contains(middle)) findWayOfAll(middle);
      if (!of_all || !(of_all->distance < 0.0)) findWayOfAll(vertex);  // the middle may be outside B
      addWayOfAll(of_all->point_on_b);
    }
    addWayOfAll(vertex);  // contacts that are spread over B do not turn it
  });
}

}  // namespace octoblisk::detail
