#include "query/simple_solid.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "base/disjoint_sets.h"
#include "base/no_index.h"
#include "query/touching_distance.h"

namespace octoblisk::detail {
namespace {

/// A bijection that spreads every bit of the input over the whole output (splitmix64's last steps).
std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

std::uint64_t hashOf(const Vec3& position) {
  std::uint64_t hash = 0x9e3779b97f4a7c15u;
  for (const double coordinate : position) {
    hash = mixed(hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) + 0x9e3779b97f4a7c15u;  // −0 is 0
  }
  return hash;
}

std::vector<std::uint64_t> hashesOf(const std::vector<Vec3>& positions) {
  std::vector<std::uint64_t> hashes(positions.size());
  std::ranges::transform(positions, hashes.begin(), hashOf);
  return hashes;
}

/// Calls visit(edge, is_forward) for the three edges of each triangle. The edge's hash is the same in both
/// directions.
template <typename Visit>
void forEachEdge(const TriangleMesh& mesh, std::span<const std::uint64_t> hashes, const Visit& visit) {
  const auto visitEdge = [&](std::uint32_t from, std::uint32_t to) {
    const auto [low, high] = std::minmax(hashes[from], hashes[to]);
    visit(mixed(low + 3 * high), low == hashes[from]);
  };
  for (const auto& [a, b, c] : mesh.triangles()) {
    visitEdge(a, b);
    visitEdge(b, c);
    visitEdge(c, a);
  }
}

/// Whether a number occurs twice. A table of bits finds the few numbers that may.
bool hasRepeats(std::span<const std::uint64_t> numbers) {
  constexpr std::size_t kBitsPerNumber = 16;
  const std::size_t bits = std::bit_ceil(std::max<std::size_t>(64, kBitsPerNumber * numbers.size()));
  std::vector<std::uint64_t> occurs(bits / 64, 0), is_suspect(bits / 64, 0);
  const auto word = [&](std::uint64_t number) { return (number & (bits - 1)) / 64; };
  const auto bit = [](std::uint64_t number) { return std::uint64_t{1} << (number & 63u); };
  for (const std::uint64_t number : numbers) {
    std::uint64_t& here = occurs[word(number)];
    is_suspect[word(number)] |= here & bit(number);
    here |= bit(number);
  }
  std::vector<std::uint64_t> suspects;
  for (const std::uint64_t number : numbers) {
    if ((is_suspect[word(number)] & bit(number)) != 0) suspects.push_back(number);
  }
  std::ranges::sort(suspects);
  return std::ranges::adjacent_find(suspects) != suspects.end();
}

/// Joins the vertices of each triangle, and counts the sets of vertices that triangles use.
std::size_t joinByIndex(const TriangleMesh& mesh, DisjointSets& connected) {
  std::vector<bool> is_used(connected.size(), false);
  std::size_t sets = 0;
  const auto use = [&](std::uint32_t vertex) {
    sets += !is_used[vertex];
    is_used[vertex] = true;
  };
  for (const TriangleMesh::Indices& triangle : mesh.triangles()) {
    for (const std::uint32_t vertex : triangle) use(vertex);
    const std::uint32_t root = connected.rootOf(triangle[0]);
    for (const std::uint32_t vertex : {triangle[1], triangle[2]}) {
      if (connected.rootOf(vertex) == root) continue;
      connected.join(vertex, root);
      --sets;
    }
  }
  return sets;
}

/// Joins the vertices at equal positions.
void joinByPosition(std::span<const std::uint64_t> hashes, DisjointSets& connected) {
  std::vector<std::uint32_t> vertex_at(std::bit_ceil(2 * hashes.size()), kNoIndex);  // a hash table
  for (std::uint32_t v = 0; v < hashes.size(); ++v) {
    std::size_t slot = hashes[v] & (vertex_at.size() - 1);
    while (vertex_at[slot] != kNoIndex && hashes[vertex_at[slot]] != hashes[v])
      slot = (slot + 1) & (vertex_at.size() - 1);
    if (vertex_at[slot] == kNoIndex) {
      vertex_at[slot] = v;
    } else {
      connected.join(v, vertex_at[slot]);
    }
  }
}

/// Whether the bounds of the components are apart, and all face outward or all inward.
bool areApart(const TriangleMesh& mesh, DisjointSets& connected) {
  std::vector<Aabb> bounds;
  std::vector<double> volume;
  std::vector<std::uint32_t> index(connected.size(), kNoIndex);
  const Vec3 middle = mesh.bounds().center();
  for (const TriangleMesh::Indices& triangle : mesh.triangles()) {
    std::uint32_t& component = index[connected.rootOf(triangle[0])];
    if (component == kNoIndex) {
      component = static_cast<std::uint32_t>(bounds.size());
      bounds.emplace_back();
      volume.push_back(0.0);
    }
    const auto arm = [&](std::size_t i) -> Vec3 { return mesh.vertices()[triangle[i]] - middle; };
    volume[component] += arm(0).dot(arm(1).cross(arm(2)));
    for (const std::uint32_t corner : triangle) bounds[component].extend(mesh.vertices()[corner]);
  }
  for (Aabb& box : bounds) box = box.grown(touchingDistance(mesh));
  Eigen::Index axis;
  mesh.bounds().halfExtents().maxCoeff(&axis);
  std::ranges::sort(bounds, {}, [axis](const Aabb& box) { return box.min[axis]; });
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    for (std::size_t j = i + 1; j < bounds.size() && bounds[j].min[axis] <= bounds[i].max[axis]; ++j) {
      if (bounds[i].meets(bounds[j])) return false;
    }
  }
  return std::ranges::all_of(volume, [](double v) { return v > 0.0; }) ||
         std::ranges::all_of(volume, [](double v) { return v < 0.0; });
}

}  // namespace

bool isSimpleSolid(const TriangleMesh& mesh) {
  const std::vector<std::uint64_t> hashes = hashesOf(mesh.vertices());
  std::uint64_t balance = 0;
  std::vector<std::uint64_t> forward;
  forward.reserve(2 * mesh.triangleCount());
  forEachEdge(mesh, hashes, [&](std::uint64_t edge, bool is_forward) {
    balance += is_forward ? edge : -edge;
    if (is_forward) forward.push_back(edge);
  });
  if (balance != 0 || 2 * forward.size() != 3 * mesh.triangleCount() || hasRepeats(forward)) return false;
  DisjointSets connected(hashes.size());
  if (joinByIndex(mesh, connected) == 1) return true;
  joinByPosition(hashes, connected);
  return areApart(mesh, connected);
}

}  // namespace octoblisk::detail
