#include "render/display_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace octoblisk::demos {
namespace {

/// Which way each vertex faces: 0 to 5 for ±x, ±y, ±z, by the mean normal of its triangles.
std::vector<std::uint8_t> facingsOf(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices().size(), Vec3::Zero());
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const Vec3 normal = scaledNormal(mesh.triangle(t));
    for (const std::uint32_t vertex : mesh.triangles()[t]) normals[vertex] += normal;
  }
  std::vector<std::uint8_t> facings;
  facings.reserve(normals.size());
  for (const Vec3& normal : normals) {
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    facings.push_back(static_cast<std::uint8_t>(2 * axis + (normal[axis] < 0.0 ? 1 : 0)));
  }
  return facings;
}

double areaOf(const TriangleMesh& mesh) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) area += 0.5 * scaledNormal(mesh.triangle(t)).norm();
  return area;
}

/// For each vertex the one that stands for its cluster: that nearest to the cluster's mean.
std::vector<std::uint32_t> representatives(const TriangleMesh& mesh, std::span<const std::uint8_t> facings,
                                           double side) {
  const std::vector<Vec3>& vertices = mesh.vertices();
  std::vector<std::pair<std::uint64_t, std::uint32_t>> by_cube;
  by_cube.reserve(vertices.size());
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    std::uint64_t key = facings[v];
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kMostCubes = (1 << 20) - 1;
      const double cube = std::floor((vertices[v][axis] - mesh.bounds().min[axis]) / side);
      key = key << 20 | static_cast<std::uint64_t>(std::clamp(cube, 0.0, kMostCubes));
    }
    by_cube.emplace_back(key, v);
  }
  std::ranges::sort(by_cube);
  std::vector<std::uint32_t> stands_for(vertices.size());
  for (std::size_t first = 0, last = 0; first < by_cube.size(); first = last) {
    Vec3 mean = Vec3::Zero();
    for (last = first; last < by_cube.size() && by_cube[last].first == by_cube[first].first; ++last) {
      mean += vertices[by_cube[last].second];
    }
    mean /= static_cast<double>(last - first);
    const auto cluster = std::span(by_cube).subspan(first, last - first);
    const auto nearest = std::ranges::min_element(
        cluster, {}, [&](const auto& entry) { return (vertices[entry.second] - mean).squaredNorm(); });
    for (const auto& [key, vertex] : cluster) stands_for[vertex] = nearest->second;
  }
  return stands_for;
}

/// The triangles that are left when vertices are replaced, by their numbers in the mesh.
std::vector<std::size_t> trianglesLeft(const TriangleMesh& mesh, std::span<const std::uint32_t> stands_for) {
  std::vector<std::size_t> left;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const auto [a, b, c] = mesh.triangles()[t];
    if (stands_for[a] == stands_for[b] || stands_for[b] == stands_for[c] || stands_for[c] == stands_for[a])
      continue;
    left.push_back(t);
  }
  return left;
}

}  // namespace

DisplayMesh displayMeshOf(const TriangleMesh& mesh, std::span<const int> group_of_triangle,
                          std::size_t most) {
  if (!group_of_triangle.empty() && group_of_triangle.size() != mesh.triangleCount()) {
    throw std::invalid_argument("displayMeshOf: not as many groups as triangles");
  }
  if (most == 0) throw std::invalid_argument("displayMeshOf: no triangles are allowed");

  DisplayMesh display;
  std::vector<std::uint32_t> stands_for(mesh.vertices().size());
  std::iota(stands_for.begin(), stands_for.end(), 0u);
  std::vector<std::size_t> left(mesh.triangleCount());
  std::iota(left.begin(), left.end(), std::size_t{0});
  if (left.size() > most) {
    // A surface meets about one and a half cubes for each square of their side, and has two triangles a
    // vertex.
    const std::vector<std::uint8_t> facings = facingsOf(mesh);
    const double extent = (mesh.bounds().max - mesh.bounds().min).maxCoeff();
    double side = std::max(std::sqrt(3.0 * areaOf(mesh) / static_cast<double>(most)), 1e-6 * extent);
    if (!(side > 0.0)) side = 1.0;  // all at one point
    for (;; side *= 1.02 * std::sqrt(static_cast<double>(left.size()) / static_cast<double>(most))) {
      stands_for = representatives(mesh, facings, side);
      left = trianglesLeft(mesh, stands_for);
      if (left.size() <= most || side > 2.0 * extent) break;
    }
    if (left.size() > most) left.resize(most);
    display.merged_within = side;
  }

  const auto group = [&](std::size_t t) { return group_of_triangle.empty() ? 0 : group_of_triangle[t]; };
  std::ranges::stable_sort(left, {}, group);
  constexpr std::uint32_t kNotYet = 0xffffffffu;
  std::vector<std::uint32_t> number(mesh.vertices().size(), kNotYet);
  for (const std::size_t t : left) {
    if (display.groups.empty() || display.groups.back().number != group(t)) {
      display.groups.push_back({group(t), display.triangles.size(), 0});
    }
    ++display.groups.back().count;
    TriangleMesh::Indices corners = mesh.triangles()[t];
    for (std::uint32_t& corner : corners) {
      std::uint32_t& drawn = number[stands_for[corner]];
      if (drawn == kNotYet) {
        drawn = static_cast<std::uint32_t>(display.vertices.size());
        display.vertices.push_back(mesh.vertices()[stands_for[corner]]);
      }
      corner = drawn;
    }
    display.triangles.push_back(corners);
  }
  return display;
}

}  // namespace octoblisk::demos
