#include "shapes/rims.h"

#include <algorithm>

namespace octoblisk::shapes {

std::uint32_t Welded::vertex(const Vec3& position) {
  const auto [place, is_new] = number_.try_emplace({position.x(), position.y(), position.z()},
                                                   static_cast<std::uint32_t>(vertices_.size()));
  if (is_new) vertices_.push_back(position);
  return place->second;
}

void Welded::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (a != b && b != c && c != a) triangles_.push_back({a, b, c});
}

void Welded::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

SharedMesh Welded::mesh() {
  return std::make_shared<const TriangleMesh>(std::move(vertices_), std::move(triangles_));
}

Rim reversed(Rim rim) {
  std::ranges::reverse(rim);
  return rim;
}

void addRing(Welded& mesh, const Rim& inner, const Rim& outer) {
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const std::size_t next = (i + 1) % inner.size();
    mesh.quad(inner[i], outer[i], outer[next], inner[next]);
  }
}

void addDisk(Welded& mesh, const Rim& rim, double z) {
  const std::uint32_t middle = mesh.vertex({0.0, 0.0, z});
  for (std::size_t i = 0; i < rim.size(); ++i) mesh.triangle(middle, rim[i], rim[(i + 1) % rim.size()]);
}

void addWall(Welded& mesh, const Rim& low, const Rim& high) {
  for (std::size_t i = 0; i < low.size(); ++i) {
    const std::size_t next = (i + 1) % low.size();
    mesh.quad(low[i], low[next], high[next], high[i]);
  }
}

}  // namespace octoblisk::shapes
