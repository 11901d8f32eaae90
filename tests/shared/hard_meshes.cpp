#include "shared/hard_meshes.h"

#include <array>
#include <cmath>

namespace octoblisk::testing {
namespace {

using Vertices = std::vector<Vec3>;
using Triangles = std::vector<TriangleMesh::Indices>;

SharedMesh meshOf(Vertices vertices, Triangles triangles) {
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

std::size_t below(std::mt19937_64& random, std::size_t count) { return random() % count; }

/// A sheet of strips whose widths differ by many powers of ten, and needles through it.
SharedMesh slivers(std::mt19937_64& random) {
  constexpr int kStrips = 30, kNeedles = 30;
  Vertices vertices;
  Triangles triangles;
  double x = -1.0;
  const double wave = uniform(random, 0.0, 0.3);
  for (std::uint32_t strip = 0; strip <= kStrips; ++strip) {
    const double height = wave * std::sin(3.0 * x);
    vertices.emplace_back(x, -1.0, height);
    vertices.emplace_back(x, 1.0, -height);
    x += strip % 3 == 0 ? 0.18 : std::pow(10.0, uniform(random, -16.0, -2.0));
    if (strip == kStrips) break;
    const std::uint32_t v = 2 * strip;
    triangles.push_back({v, v + 2, v + 3});
    triangles.push_back({v, v + 3, v + 1});
  }
  for (int needle = 0; needle < kNeedles; ++needle) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    const Vec3 from = randomPoint(random, 0.8), to = randomPoint(random, 0.8);
    vertices.push_back(from);
    vertices.push_back(to);
    const double width = std::pow(10.0, uniform(random, -17.0, -3.0));
    const Vec3 off_line = randomPoint(random, width);
    vertices.emplace_back(from + uniform(random, -0.2, 1.2) * (to - from) + off_line);
    triangles.push_back({first, first + 1, first + 2});
  }
  return meshOf(std::move(vertices), std::move(triangles));
}

SharedMesh duplicates(std::mt19937_64& random) {
  const SharedMesh base = torus(1.0, 0.4, 8, 4);
  Vertices vertices = base->vertices();
  Triangles triangles = base->triangles();
  const std::size_t count = triangles.size();
  for (std::size_t copies = 0; copies < 50; ++copies) {
    TriangleMesh::Indices corners = triangles[below(random, count)];
    if (copies % 3 == 0) std::swap(corners[0], corners[1]);
    if (copies % 3 == 1) {
      for (std::uint32_t& corner : corners) {
        vertices.push_back(Vec3(vertices[corner]));
        corner = static_cast<std::uint32_t>(vertices.size() - 1);
      }
    }
    triangles.push_back(corners);
  }
  return meshOf(std::move(vertices), std::move(triangles));
}

/// Triangles of a box and a torus, some repeatedly divided at the middle of an edge. Their neighbours stay
/// undivided.
SharedMesh tJunctions(std::mt19937_64& random) {
  Vec3 half;
  for (int k = 2; k >= 0; --k) half[k] = uniform(random, k == 2 ? 0.02 : 0.3, 0.9);
  const SharedMesh base = random() % 2 == 0 ? boxMesh(half) : torus(0.8, 0.3, 6, 4);
  Vertices vertices = base->vertices();
  Triangles triangles = base->triangles();
  while (triangles.size() < 100) {
    const std::size_t cut = below(random, triangles.size());
    const auto [a, b, c] = triangles[cut];
    const auto middle = static_cast<std::uint32_t>(vertices.size());
    const double part = random() % 2 == 0 ? 0.5 : uniform(random, 0.1, 0.9);
    vertices.emplace_back(vertices[a] + part * (vertices[b] - vertices[a]));
    triangles[cut] = {middle, b, c};
    triangles.push_back({c, a, middle});
  }
  return meshOf(std::move(vertices), std::move(triangles));
}

SharedMesh openEdges(std::mt19937_64& random) {
  const SharedMesh base = random() % 2 == 0 ? waveSheet(1.0, 0.4, 8) : bumpySphere(random, 1.0, 0.3, 10);
  Triangles triangles = base->triangles();
  const std::size_t left = triangles.size() / 2;
  while (triangles.size() > left) {
    std::swap(triangles[below(random, triangles.size())], triangles.back());
    triangles.pop_back();
  }
  return meshOf(base->vertices(), std::move(triangles));
}

}  // namespace

const char* nameOf(MeshKind kind) {
  constexpr std::array<const char*, kMeshKinds> kNames = {"solid",       "slivers",    "duplicates",
                                                          "T-junctions", "open edges", "soup"};
  return kNames[static_cast<std::size_t>(kind)];
}

SharedMesh hardMesh(std::mt19937_64& random, MeshKind kind) {
  switch (kind) {
    case MeshKind::solid:
      return bumpySphere(random, 1.0, 0.4, 10);
    case MeshKind::slivers:
      return slivers(random);
    case MeshKind::duplicates:
      return duplicates(random);
    case MeshKind::tJunctions:
      return tJunctions(random);
    case MeshKind::openEdges:
      return openEdges(random);
    case MeshKind::soup:
      break;
  }
  return soup(random, 64, 0.8, 0.4);
}

}  // namespace octoblisk::testing
