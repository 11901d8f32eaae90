#include "paper/surface_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>
#include <string>

#include "paper/uniform.h"

namespace octoblisk::demos {
namespace {

constexpr std::size_t kCandidatesPerPoint = 10;

/// Uniform over a triangle (R. Osada et al., Shape distributions, 2002, eq. 1).
Vec3 pointIn(const Triangle& t, std::mt19937_64& random) {
  const double root = std::sqrt(uniform(random)), along = uniform(random);
  return (1.0 - root) * t[0] + root * (1.0 - along) * t[1] + root * along * t[2];
}

/// The area up to and including each triangle.
std::vector<double> cumulativeArea(const TriangleMesh& mesh) {
  std::vector<double> area_to;
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    sum += 0.5 * scaledNormal(mesh.triangle(t)).norm();
    area_to.push_back(sum);
  }
  return area_to;
}

std::vector<Vec3> candidates(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  const std::vector<double> area_to = cumulativeArea(mesh);
  if (!(area_to.back() > 0.0)) throw std::invalid_argument("the mesh has no area to take points from");
  std::mt19937_64 random(seed);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double area = uniform(random) * area_to.back();
    const auto above = std::ranges::upper_bound(area_to, area);
    const auto t = std::min<std::ptrdiff_t>(above - area_to.begin(), std::ssize(area_to) - 1);
    points.push_back(pointIn(mesh.triangle(static_cast<std::size_t>(t)), random));
  }
  return points;
}

}  // namespace

std::vector<Vec3> evenPoints(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  if (count == 0) throw std::invalid_argument("a point cloud needs at least one point");
  const std::vector<Vec3> pool = candidates(mesh, kCandidatesPerPoint * count, seed);
  std::vector<double> squared_distance(pool.size(), std::numeric_limits<double>::infinity());
  std::vector<Vec3> points;
  std::size_t farthest = 0;
  while (points.size() < count) {
    const Vec3 taken = pool[farthest];
    points.push_back(taken);
    double most = -1.0;
    for (std::size_t i = 0; i < pool.size(); ++i) {
      squared_distance[i] = std::min(squared_distance[i], (pool[i] - taken).squaredNorm());
      if (squared_distance[i] > most) most = squared_distance[farthest = i];
    }
  }
  return points;
}

double surfaceArea(const TriangleMesh& mesh) { return cumulativeArea(mesh).back(); }

TriangleMesh partOf(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
  std::map<std::uint32_t, std::uint32_t> new_index;
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> renumbered;
  for (const std::uint32_t t : triangles) {
    TriangleMesh::Indices corners = mesh.triangles()[t];
    for (std::uint32_t& corner : corners) {
      const auto [known, is_new] = new_index.try_emplace(corner, static_cast<std::uint32_t>(vertices.size()));
      if (is_new) vertices.push_back(mesh.vertices()[corner]);
      corner = known->second;
    }
    renumbered.push_back(corners);
  }
  return {std::move(vertices), std::move(renumbered)};
}

TriangleMesh partOf(const TriangleMesh& mesh, std::span<const int> number_of_triangle, int number) {
  if (number_of_triangle.size() != mesh.triangleCount()) {
    throw std::invalid_argument("there are " + std::to_string(number_of_triangle.size()) + " numbers for " +
                                std::to_string(mesh.triangleCount()) + " triangles");
  }
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < number_of_triangle.size(); ++t) {
    if (number_of_triangle[t] == number) triangles.push_back(t);
  }
  return partOf(mesh, triangles);
}

}  // namespace octoblisk::demos
