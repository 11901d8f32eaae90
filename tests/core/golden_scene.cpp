#include "core/golden_scene.h"

#include <bit>
#include <cmath>
#include <map>

#include "base/checksum.h"

namespace octoblisk::testing {

using namespace detail;

SharedMesh bumpyBall(std::mt19937_64& random, double radius, double bump, int segments) {
  using Cell = std::array<int, 3>;
  std::map<Cell, std::uint32_t> known;
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  const auto vertex = [&](const Cell& cell) {
    const auto [at, is_new] = known.try_emplace(cell, static_cast<std::uint32_t>(vertices.size()));
    if (is_new) {
      const double x = 2.0 * cell[0] - segments, y = 2.0 * cell[1] - segments, z = 2.0 * cell[2] - segments;
      const double scale = (radius + uniform(random, -bump, bump)) / std::sqrt((x * x + y * y) + z * z);
      vertices.emplace_back(scale * x, scale * y, scale * z);
    }
    return at->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {0, segments}) {
      for (int i = 0; i < segments; ++i) {
        for (int j = 0; j < segments; ++j) {
          const auto at = [&](int u, int v) {
            Cell cell = {};
            cell[axis] = side;
            cell[(axis + 1) % 3] = side == 0 ? i + v : i + u;  // outward
            cell[(axis + 2) % 3] = side == 0 ? j + u : j + v;
            return vertex(cell);
          };
          const std::uint32_t a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
          triangles.push_back({a, b, c});
          triangles.push_back({a, c, d});
        }
      }
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

Pose poseAt(std::mt19937_64& random, double distance) {
  double w, x, y, z, square;
  do {
    w = uniform(random, -1, 1), x = uniform(random, -1, 1);
    y = uniform(random, -1, 1), z = uniform(random, -1, 1);
    square = (w * w + x * x) + (y * y + z * z);
  } while (square > 1.0 || square < 0.01);
  const double s = 2.0 / square;
  Pose pose;
  pose.rotation << 1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
      s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),               //
      s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y);
  do {
    x = uniform(random, -1, 1), y = uniform(random, -1, 1), z = uniform(random, -1, 1);
    square = (x * x + y * y) + z * z;
  } while (square > 1.0 || square < 0.01);
  const double scale = distance / std::sqrt(square);
  pose.translation = {scale * x, scale * y, scale * z};
  return pose;
}

void Answers::add(double number) { add(std::bit_cast<std::uint64_t>(number)); }

std::uint64_t Answers::hash() const { return xxh64(bytes_); }

}  // namespace octoblisk::testing
