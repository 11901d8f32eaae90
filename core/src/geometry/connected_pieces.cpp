#include "geometry/connected_pieces.h"

#include <bit>
#include <numeric>

#include "geometry/position_hash.h"

namespace octoblisk::detail {
namespace {

/// Disjoint sets of vertices (B. A. Galler, M. J. Fischer, An improved equivalence algorithm, 1964).
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t rootOf(std::uint32_t vertex) {
    while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[rootOf(a)] = rootOf(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Joins vertices at equal positions, by a hash table of positions.
void weld(const std::vector<Vec3>& vertices, Sets& sets) {
  constexpr std::uint32_t kFree = 0xffffffffu;
  const std::size_t size = std::bit_ceil(2 * vertices.size() + 1);
  std::vector<std::uint32_t> table(size, kFree);
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    std::size_t place = hashOf(vertices[v]) & (size - 1);
    while (table[place] != kFree && vertices[table[place]] != vertices[v]) place = (place + 1) & (size - 1);
    if (table[place] == kFree) {
      table[place] = v;
    } else {
      sets.join(v, table[place]);
    }
  }
}

}  // namespace

std::vector<std::uint32_t> connectedPieces(const TriangleMesh& mesh) {
  Sets sets(mesh.vertices().size());
  weld(mesh.vertices(), sets);
  for (const auto& [a, b, c] : mesh.triangles()) {
    sets.join(a, b);
    sets.join(b, c);
  }
  std::vector<std::uint32_t> pieces(mesh.vertices().size());
  for (std::uint32_t v = 0; v < pieces.size(); ++v) pieces[v] = sets.rootOf(v);
  return pieces;
}

}  // namespace octoblisk::detail
