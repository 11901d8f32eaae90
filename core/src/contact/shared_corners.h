// Finds the triangles that share a corner or an edge.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

inline constexpr std::uint32_t kNoIndex = 0xffffffffu;  // no triangle, corner or place

inline bool hasCorner(const Triangle& triangle, const Vec3& position) {
  return std::ranges::find(triangle, position) != triangle.end();
}

/// Finds triangles by their corners, or by their edges; one object is for one of the two. Allocates nothing
/// once warm.
class SharedCorners {
 public:
  void clear() {
    places_.clear();
    first_.clear();
  }
  void reserve(std::size_t triangles) { places_.reserve(3 * triangles); }

  /// `index` identifies the triangle.
  void addCorners(const Triangle& triangle, std::uint32_t index) {
    for (const Vec3& corner : triangle) add(keyOf(corner), index);
  }
  void addEdges(const Triangle& triangle, std::uint32_t index) {
    for (std::size_t v = 0; v < 3; ++v) add(keyOf(triangle[v]) + keyOf(triangle[(v + 1) % 3]), index);
  }

  /// Calls visit(index) for each triangle that has the corner, and for few others, until a call returns true.
  /// Returns whether one did.
  template <typename Visit>
  bool anyAt(const Vec3& corner, Visit&& visit) const {
    return anyWith(keyOf(corner), visit);
  }
  /// The same for an edge.
  template <typename Visit>
  bool anyAlong(const Vec3& from, const Vec3& to, Visit&& visit) const {
    return anyWith(keyOf(from) + keyOf(to), visit);
  }

 private:
  /// A corner or an edge of a triangle.
  struct Place {
    double key;
    std::uint32_t index;
    std::uint32_t next;  // place in the same slot
  };

  /// Looking at all of a few places takes less time than a table.
  bool areFew() const {
    constexpr std::size_t kFew = 48;
    return places_.size() <= kFew;
  }

  /// Equal for equal positions, almost never for different ones.
  static double keyOf(const Vec3& position) {
    return position.dot(Vec3(1.0, 0.61803398874989485, 0.41421356237309505)) + 0.0;  // -0 is 0
  }

  std::size_t slotOf(double key) const {
    const std::uint64_t mixed = std::bit_cast<std::uint64_t>(key) * 0x9e3779b97f4a7c15u;
    return mixed >> (64 - std::countr_zero(first_.size()));
  }

  void add(double key, std::uint32_t index) {
    places_.push_back({key, index, kNoIndex});
    if (areFew()) return;
    if (places_.size() <= first_.size()) {
      chain(places_.size() - 1);
    } else {
      first_.assign(2 * std::bit_ceil(places_.size()), kNoIndex);
      for (std::size_t place = 0; place < places_.size(); ++place) chain(place);
    }
  }

  void chain(std::size_t place) {
    std::uint32_t& first = first_[slotOf(places_[place].key)];
    places_[place].next = first;
    first = static_cast<std::uint32_t>(place);
  }

  template <typename Visit>
  bool anyWith(double key, Visit&& visit) const {
    if (areFew()) {
      return std::ranges::any_of(places_,
                                 [&](const Place& place) { return place.key == key && visit(place.index); });
    }
    for (std::uint32_t place = first_[slotOf(key)]; place != kNoIndex; place = places_[place].next) {
      if (places_[place].key == key && visit(places_[place].index)) return true;
    }
    return false;
  }

  std::vector<Place> places_;
  std::vector<std::uint32_t> first_;  // per slot of the table: the place added last; empty if there are few
};

}  // namespace octoblisk::detail
