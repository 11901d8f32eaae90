#include "geometry/oriented_closed.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

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

}  // namespace

bool isOrientedClosed(const TriangleMesh& mesh) {
  std::vector<std::uint64_t> hashes(mesh.vertices().size());
  std::ranges::transform(mesh.vertices(), hashes.begin(), hashOf);
  const auto edge = [&](std::uint32_t from, std::uint32_t to) {
    return mixed(hashes[from] + 3 * hashes[to]);  // differs from that of the reversed edge
  };
  std::uint64_t balance = 0;
  for (const auto& [a, b, c] : mesh.triangles()) {
    balance += edge(a, b) - edge(b, a) + edge(b, c) - edge(c, b) + edge(c, a) - edge(a, c);
  }
  return balance == 0;
}

}  // namespace octoblisk::detail
