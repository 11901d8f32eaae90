#include "octoblisk/surface.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/no_index.h"
#include "query/solid_parts.h"

namespace octoblisk {

using namespace detail;

Surface::Surface(const ClusteredOctree& tree, int threads) : Surface(tree, OnlyConnected()) {
  solid_ = SolidParts::of(*this, threads);
}

Surface::Surface(const ClusteredOctree& tree, OnlyConnected) : tree_(&tree) {
  weld();
  gatherStars();
  findComponents();
}

const ClusteredOctree& Surface::boundary() const { return boundaryOf(*this).tree(); }

std::uint32_t Surface::sourceOf(std::uint32_t boundary_triangle) const {
  return solid_->boundary ? solid_->boundary->source[boundary_triangle] : boundary_triangle;
}

void Surface::weld() {
  const TriangleMesh& mesh = tree_->mesh();
  const std::vector<Vec3>& vertices = mesh.vertices();
  std::vector<std::uint32_t> corner_of(vertices.size(), kNoIndex);
  for (const TriangleMesh::Indices& triangle : mesh.triangles()) {
    for (const std::uint32_t vertex : triangle) corner_of[vertex] = 0;
  }
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    if (corner_of[v] != kNoIndex) order.push_back(v);
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

void Surface::findComponents() {
  DisjointSets connected(vertex_.size());
  for (const auto& [a, b, c] : corners_) {
    connected.join(b, a);
    connected.join(c, a);
  }
  component_.assign(vertex_.size(), kNoIndex);
  for (std::uint32_t corner = 0; corner < vertex_.size(); ++corner) {
    std::uint32_t& of_root = component_[connected.rootOf(corner)];
    if (of_root == kNoIndex) {
      of_root = static_cast<std::uint32_t>(component_corner_.size());
      component_corner_.push_back(corner);
    }
    component_[corner] = of_root;
  }
}

}  // namespace octoblisk
