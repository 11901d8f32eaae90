#include "render/display_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace octoblisk::demos {
namespace {

using Corners = std::vector<unsigned>;  // three indices per triangle

struct Positions {
  std::vector<float> coordinates;
  float scale;  // factor of relative errors

  explicit Positions(const TriangleMesh& mesh) {
    for (const Vec3& vertex : mesh.vertices()) {
      for (const double x : vertex - mesh.bounds().center()) coordinates.push_back(static_cast<float>(x));
    }
    scale = meshopt_simplifyScale(coordinates.data(), count(), kStride);
  }
  std::size_t count() const { return coordinates.size() / 3; }

  static constexpr std::size_t kStride = 3 * sizeof(float);
};

/// Simplifies the triangles of a group to about `most`. Returns the error.
double simplify(const Positions& positions, std::size_t most, Corners& corners) {
  constexpr float kAnyError = 1e9f;
  float error = 0.0f;
  corners.resize(meshopt_simplify(corners.data(), corners.data(), corners.size(),
                                  positions.coordinates.data(), positions.count(), Positions::kStride,
                                  3 * most, kAnyError, meshopt_SimplifyLockBorder, &error));
  return double(error) * double(positions.scale);
}

}  // namespace

DisplayMesh displayMeshOf(const TriangleMesh& mesh, std::span<const int> group_of_triangle,
                          std::size_t most) {
  if (!group_of_triangle.empty() && group_of_triangle.size() != mesh.triangleCount()) {
    throw std::invalid_argument("displayMeshOf: the numbers of groups and triangles differ");
  }
  if (most == 0) throw std::invalid_argument("displayMeshOf: the number of triangles must be above 0");

  std::map<int, Corners> groups;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    Corners& corners = groups[group_of_triangle.empty() ? 0 : group_of_triangle[t]];
    corners.insert(corners.end(), mesh.triangles()[t].begin(), mesh.triangles()[t].end());
  }
  DisplayMesh display;
  display.is_simplified = mesh.triangleCount() > most;
  if (display.is_simplified) {
    const Positions positions(mesh);
    const double share = static_cast<double>(most) / static_cast<double>(mesh.triangleCount());
    for (auto& [number, corners] : groups) {
      const auto most_of_group = static_cast<std::size_t>(share * static_cast<double>(corners.size() / 3));
      display.error = std::max(display.error, simplify(positions, most_of_group, corners));
    }
  }

  constexpr std::uint32_t kNotYet = 0xffffffffu;
  std::vector<std::uint32_t> number_of(mesh.vertices().size(), kNotYet);
  for (const auto& [number, corners] : groups) {
    const std::size_t first = display.triangles.size();
    for (std::size_t i = 0; i < corners.size() && display.triangles.size() < most; i += 3) {
      TriangleMesh::Indices triangle = {corners[i], corners[i + 1], corners[i + 2]};
      for (std::uint32_t& corner : triangle) {
        std::uint32_t& drawn = number_of[corner];
        if (drawn == kNotYet) {
          drawn = static_cast<std::uint32_t>(display.vertices.size());
          display.vertices.push_back(mesh.vertices()[corner]);
        }
        corner = drawn;
      }
      display.triangles.push_back(triangle);
    }
    if (const std::size_t count = display.triangles.size() - first; count > 0) {
      display.groups.push_back({number, first, count});
    }
  }
  return display;
}

}  // namespace octoblisk::demos
