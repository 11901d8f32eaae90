#include "query/copies.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "octoblisk/contact.h"
#include "query/touching_distance.h"

namespace octoblisk::detail {

Copies findCopies(const Surface& surface) {
  const TriangleMesh& mesh = surface.tree().mesh();
  const double tolerance = touchingDistance(mesh);
  std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> order;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    if (!hasArea(mesh.triangle(t), tolerance)) continue;
    std::array<std::uint32_t, 3> corners = surface.corners(t);
    std::ranges::sort(corners);
    order.emplace_back(corners, t);
  }
  std::ranges::sort(order);
  Copies copies;
  copies.original.resize(mesh.triangleCount());
  std::iota(copies.original.begin(), copies.original.end(), 0u);
  copies.count.assign(mesh.triangleCount(), 1);
  for (auto begin = order.begin(), end = begin; begin != order.end(); begin = end) {
    const std::uint32_t first = begin->second;
    std::uint32_t turned = kNoTriangle;  // the first that faces the other way
    int balance = 0;
    for (; end != order.end() && end->first == begin->first; ++end) {
      const bool is_turned = !areSameWay(surface, end->second, first);
      if (is_turned && turned == kNoTriangle) turned = end->second;
      balance += is_turned ? -1 : 1;
      if (end != begin) copies.triangles.push_back(end->second);
    }
    copies.count[first] = balance < 0 ? -1 : 1;
    for (auto copy = begin; copy != end; ++copy) {
      const bool is_turned = balance == 0 && !areSameWay(surface, copy->second, first);
      copies.original[copy->second] = is_turned ? turned : first;
    }
  }
  std::ranges::sort(copies.triangles);
  copies.are_left_out = false;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) copies.are_left_out |= copies.original[t] != t;
  return copies;
}

bool areSameWay(const Surface& surface, std::uint32_t a, std::uint32_t b) {
  const auto &of_a = surface.corners(a), &of_b = surface.corners(b);
  const auto first = static_cast<std::size_t>(std::ranges::find(of_b, of_a[0]) - of_b.begin());
  return of_b[(first + 1) % 3] == of_a[1];
}

}  // namespace octoblisk::detail
