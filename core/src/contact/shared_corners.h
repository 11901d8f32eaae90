// Finds the triangles that share a corner or an edge.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/no_index.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

inline bool hasCorner(const Triangle& triangle, const Vec3& position) {
  return std::ranges::find(triangle, position) != triangle.end();
}

/// Finds triangles by their corners, or by their edges; one object is for one of the two. Triangles are
/// numbered from 0. Allocates nothing once warm.
class SharedCorners {
 public:
  void clear() {
    count_ = 0;
    places_.clear();
    first_.clear();
  }

  /// The number of triangles.
  std::size_t size() const { return count_; }

  /// Adds the triangle with the next number. `triangleOf(number)` returns this triangle and all added before.
  template <typename TriangleOf>
  void addCorners(TriangleOf&& triangleOf) {
    add(triangleOf, [](const Triangle& triangle, std::size_t v) { return keyOf(triangle[v]); });
  }
  /// The same for edges.
  template <typename TriangleOf>
  void addEdges(TriangleOf&& triangleOf) {
    add(triangleOf, [](const Triangle& triangle, std::size_t v) {
      return keyOf(triangle[v]) + keyOf(triangle[(v + 1) % 3]);
    });
  }

  /// Calls visit(number) for each triangle that has the corner, and for some others, until a call returns
  /// true. Returns whether one did.
  template <typename Visit>
  bool anyAt(const Vec3& corner, Visit&& visit) const {
    return areFew() ? anyOfFew(visit) : anyWith(keyOf(corner), visit);
  }
  /// The same for an edge.
  template <typename Visit>
  bool anyAlong(const Vec3& from, const Vec3& to, Visit&& visit) const {
    return areFew() ? anyOfFew(visit) : anyWith(keyOf(from) + keyOf(to), visit);
  }

 private:
  /// A corner or an edge of a triangle.
  struct Place {
    double key;
    std::uint32_t number;
    std::uint32_t next;  // place in the same slot
  };

  /// Looking at all of a few triangles takes less time than a table.
  bool areFew() const {
    constexpr std::uint32_t kFew = 16;
    return count_ <= kFew;
  }

  /// Equal for equal positions, almost never for different ones.
  static double keyOf(const Vec3& position) {
    return position.dot(Vec3(1.0, 0.61803398874989485, 0.41421356237309505)) + 0.0;  // -0 is 0
  }

  std::size_t slotOf(double key) const {
    const std::uint64_t mixed = std::bit_cast<std::uint64_t>(key) * 0x9e3779b97f4a7c15u;
    return mixed >> (64 - std::countr_zero(first_.size()));
  }

  template <typename TriangleOf, typename KeyAt>
  void add(TriangleOf&& triangleOf, KeyAt&& keyAt) {
    ++count_;
    if (areFew()) return;
    for (std::uint32_t number = places_.empty() ? 0 : count_ - 1; number < count_; ++number) {
      const Triangle& triangle = triangleOf(number);
      for (std::size_t v = 0; v < 3; ++v) addPlace(keyAt(triangle, v), number);
    }
  }

  void addPlace(double key, std::uint32_t number) {
    places_.push_back({key, number, kNoIndex});
    if (places_.size() <= first_.size()) {
      chain(places_.size() - 1);
    } else {
      constexpr std::size_t kLeastSlots = 128;
      first_.assign(std::max(kLeastSlots, 2 * std::bit_ceil(places_.size())), kNoIndex);
      for (std::size_t place = 0; place < places_.size(); ++place) chain(place);
    }
  }

  void chain(std::size_t place) {
    std::uint32_t& first = first_[slotOf(places_[place].key)];
    places_[place].next = first;
    first = static_cast<std::uint32_t>(place);
  }

  template <typename Visit>
  bool anyOfFew(Visit&& visit) const {
    for (std::uint32_t number = 0; number < count_; ++number) {
      if (visit(number)) return true;
    }
    return false;
  }
  template <typename Visit>
  bool anyWith(double key, Visit&& visit) const {
    for (std::uint32_t place = first_[slotOf(key)]; place != kNoIndex; place = places_[place].next) {
      if (places_[place].key == key && visit(places_[place].number)) return true;
    }
    return false;
  }

  std::uint32_t count_ = 0;           // of triangles
  std::vector<Place> places_;         // none if the triangles are few
  std::vector<std::uint32_t> first_;  // per slot of the table: the place added last
};

}  // namespace octoblisk::detail
