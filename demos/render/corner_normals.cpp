#include "render/corner_normals.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "models/welded_surface.h"

namespace octoblisk::demos {
namespace {

/// The triangles around each place: those of the place of vertex p are triangles[first[p]] …
/// triangles[first[p + 1] − 1].
struct Fans {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> triangles;
};

Fans fansOf(std::span<const std::uint32_t> place, std::span<const TriangleMesh::Indices> triangles) {
  Fans fans;
  fans.first.assign(place.size() + 1, 0);
  for (const auto& corners : triangles) {
    for (const std::uint32_t corner : corners) ++fans.first[place[corner] + 1];
  }
  std::partial_sum(fans.first.begin(), fans.first.end(), fans.first.begin());

  fans.triangles.resize(3 * triangles.size());
  std::vector<std::uint32_t> next(fans.first.begin(), fans.first.end() - 1);
  for (std::uint32_t index = 0; index < triangles.size(); ++index) {
    for (const std::uint32_t corner : triangles[index]) fans.triangles[next[place[corner]]++] = index;
  }
  return fans;
}

}  // namespace

std::vector<CornerNormals> cornerNormals(std::span<const Vec3> vertices,
                                         std::span<const TriangleMesh::Indices> triangles,
                                         double crease_angle) {
  const std::vector<std::uint32_t> place = firstAtSamePlace(vertices);
  const Fans fans = fansOf(place, triangles);

  std::vector<Vec3> area_normals;  // of twice the triangle's area in length
  std::vector<Vec3> unit_normals;
  area_normals.reserve(triangles.size());
  unit_normals.reserve(triangles.size());
  for (const auto& corners : triangles) {
    area_normals.push_back(
        scaledNormal(Triangle{vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]}));
    unit_normals.push_back(area_normals.back().normalized());
  }

  const double least_cosine = std::cos(crease_angle);
  std::vector<CornerNormals> result(triangles.size());
  for (std::size_t index = 0; index < triangles.size(); ++index) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t here = place[triangles[index][corner]];
      Vec3 sum = Vec3::Zero();
      for (std::uint32_t slot = fans.first[here]; slot < fans.first[here + 1]; ++slot) {
        const std::uint32_t other = fans.triangles[slot];
        if (unit_normals[other].dot(unit_normals[index]) >= least_cosine) sum += area_normals[other];
      }
      result[index][corner] = sum.normalized().cast<float>();
    }
  }
  return result;
}

}  // namespace octoblisk::demos
