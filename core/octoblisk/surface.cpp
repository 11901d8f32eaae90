#include "octoblisk/surface.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace octoblisk {
namespace {

struct Edge {
  std::uint32_t low, high;  // corners
  int direction;            // +1 from low to high

  Edge(std::uint32_t from, std::uint32_t to)
      : low(std::min(from, to)), high(std::max(from, to)), direction(from < to ? 1 : -1) {}
  auto ends() const { return std::pair(low, high); }
};

}  // namespace

Surface::Surface(const ClusteredOctree& tree) : tree_(&tree) {
  weld();
  checkEdges();
  gatherStars();
  findParts();
}

void Surface::weld() {
  const TriangleMesh& mesh = tree_->mesh();
  const std::vector<Vec3>& vertices = mesh.vertices();
  constexpr std::uint32_t kUnused = 0xffffffffu;
  std::vector<std::uint32_t> corner_of(vertices.size(), kUnused);
  for (const TriangleMesh::Indices& triangle : mesh.triangles()) {
    for (const std::uint32_t vertex : triangle) corner_of[vertex] = 0;
  }
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    if (corner_of[v] != kUnused) order.push_back(v);
  }
  const auto position = [&](std::uint32_t v) {
    return std::tie(vertices[v].x(), vertices[v].y(), vertices[v].z());
  };
  std::ranges::sort(order, [&](std::uint32_t v, std::uint32_t w) {
    return std::tuple_cat(position(v), std::tie(v)) < std::tuple_cat(position(w), std::tie(w));
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || position(order[i]) != position(order[i - 1])) vertex_.push_back(order[i]);
    corner_of[order[i]] = static_cast<std::uint32_t>(vertex_.size() - 1);
  }
  corners_.reserve(mesh.triangleCount());
  for (const auto& [a, b, c] : mesh.triangles())
    corners_.push_back({corner_of[a], corner_of[b], corner_of[c]});
}

void Surface::checkEdges() {
  std::vector<Edge> edges;
  edges.reserve(3 * corners_.size());
  for (const auto& corner : corners_) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (corner[i] != corner[(i + 1) % 3]) edges.emplace_back(corner[i], corner[(i + 1) % 3]);
    }
  }
  std::ranges::sort(edges, {}, &Edge::ends);
  for (auto edge = edges.begin(); edge != edges.end();) {
    int uses = 0, balance = 0;
    const auto ends = edge->ends();
    for (; edge != edges.end() && edge->ends() == ends; ++edge, ++uses) balance += edge->direction;
    closed_ &= uses % 2 == 0;
    oriented_ &= balance == 0;
  }
}

void Surface::gatherStars() {
  star_begin_.assign(vertex_.size() + 1, 0);
  for (const auto& triangle : corners_) {
    for (const std::uint32_t corner : triangle) ++star_begin_[corner + 1];
  }
  std::partial_sum(star_begin_.begin(), star_begin_.end(), star_begin_.begin());
  stars_.resize(3 * corners_.size());
  std::vector<std::uint32_t> end(star_begin_.begin(), star_begin_.end() - 1);
  for (std::uint32_t t = 0; t < corners_.size(); ++t) {
    for (const std::uint32_t corner : corners_[t]) stars_[end[corner]++] = t;
  }
}

void Surface::findParts() {
  constexpr std::uint32_t kNone = 0xffffffffu;
  part_.assign(vertex_.size(), kNone);
  std::vector<std::uint32_t> open;
  for (std::uint32_t first = 0; first < vertex_.size(); ++first) {
    if (part_[first] != kNone) continue;
    const auto part = static_cast<std::uint32_t>(part_corner_.size());
    part_corner_.push_back(first);
    part_[first] = part;
    open.push_back(first);
    while (!open.empty()) {
      const std::uint32_t corner = open.back();
      open.pop_back();
      for (const std::uint32_t t : star(corner)) {
        for (const std::uint32_t next : corners_[t]) {
          if (part_[next] != kNone) continue;
          part_[next] = part;
          open.push_back(next);
        }
      }
    }
  }
}

}  // namespace octoblisk
