#include "geometry/polygon_triangles.h"

#include <algorithm>
#include <set>
#include <utility>

#include "geometry/predicates.h"

namespace octoblisk::detail {
namespace {

/// Whether the direction from `at` to `point` points strictly into the inside of a ring that runs from `last`
/// over `at` to `next`.
bool pointsInside(const Vec2& last, const Vec2& at, const Vec2& next, const Vec2& point) {
  const bool left_of_next = orient2d(at, next, point) > 0, left_of_last = orient2d(last, at, point) > 0;
  const bool is_convex = orient2d(last, at, next) > 0;
  return is_convex ? left_of_next && left_of_last : left_of_next || left_of_last;
}

/// Whether a point on the line through a and b is between them, or equals one of them.
bool isBetween(const Vec2& a, const Vec2& b, const Vec2& point) {
  return (point.array() >= a.cwiseMin(b).array()).all() && (point.array() <= a.cwiseMax(b).array()).all();
}

/// Whether two segments share a point. If they share an end, only whether they share more.
bool cross(const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
  const auto liesOn = [](const Vec2& point, const Vec2& from, const Vec2& to) {
    return point != from && point != to && orient2d(from, to, point) == 0 && isBetween(from, to, point);
  };
  if (liesOn(p, a, b) || liesOn(q, a, b) || liesOn(a, p, q) || liesOn(b, p, q)) return true;
  return orient2d(a, b, p) * orient2d(a, b, q) < 0 && orient2d(p, q, a) * orient2d(p, q, b) < 0;
}

/// The ring and a hole in it as one ring: over a bridge from the ring to the hole, around it, and back. Empty
/// if there is no bridge.
Ring withHole(std::span<const Vec2> points, const Ring& ring, const Ring& hole,
              const std::vector<Ring>& other_holes) {
  const auto lessInX = [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(points[a].x(), points[a].y()) < std::pair(points[b].x(), points[b].y());
  };
  const auto begin = static_cast<std::size_t>(std::ranges::max_element(hole, lessInX) - hole.begin());
  const Vec2& from = points[hole[begin]];
  std::vector<std::size_t> nearest(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i) nearest[i] = i;
  std::ranges::stable_sort(nearest, {},
                           [&](std::size_t i) { return (points[ring[i]] - from).squaredNorm(); });
  const auto crosses = [&](const Ring& obstacle, const Vec2& to) {
    for (std::size_t i = 0; i < obstacle.size(); ++i) {
      if (cross(from, to, points[obstacle[i]], points[obstacle[(i + 1) % obstacle.size()]])) return true;
    }
    return false;
  };
  for (const std::size_t i : nearest) {
    const Vec2& to = points[ring[i]];
    const Vec2 &last = points[ring[(i + ring.size() - 1) % ring.size()]],
               &next = points[ring[(i + 1) % ring.size()]];
    if (!pointsInside(last, to, next, from) || crosses(ring, to) || crosses(hole, to)) continue;
    if (std::ranges::any_of(other_holes, [&](const Ring& other) { return crosses(other, to); })) continue;
    Ring joined(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    for (std::size_t k = 0; k <= hole.size(); ++k) joined.push_back(hole[(begin + k) % hole.size()]);
    joined.insert(joined.end(), ring.begin() + static_cast<std::ptrdiff_t>(i), ring.end());
    return joined;
  }
  return {};
}

/// Clips ears off a ring. As all of them turn left, they cover the ring's inside once, if it is simple.
class EarClipper {
 public:
  EarClipper(std::span<const Vec2> points, const Ring& ring) : points_(points), ring_(ring) {
    const std::size_t count = ring.size();
    for (std::size_t i = 0; i < count; ++i) {
      last_.push_back((i + count - 1) % count);
      next_.push_back((i + 1) % count);
    }
    is_convex_.assign(count, false);
    for (std::size_t i = 0; i < count; ++i) add(i);
  }

  std::vector<std::array<std::uint32_t, 3>> clipAll() {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t left = ring_.size(); left >= 3; --left) {
      const auto ear = std::ranges::find_if(candidates_, [&](const auto& c) { return isEar(c.second); });
      if (ear == candidates_.end()) return {};
      const std::size_t at = ear->second, last = last_[at], next = next_[at];
      triangles.push_back({ring_[last], ring_[at], ring_[next]});
      for (const std::size_t changed : {last, at, next}) remove(changed);
      next_[last] = next;
      last_[next] = last;
      if (left == 3) break;
      add(last);
      add(next);
    }
    return triangles;
  }

 private:
  const Vec2& point(std::size_t i) const { return points_[ring_[i]]; }
  std::pair<double, std::size_t> candidate(std::size_t i) const {
    return {(point(next_[i]) - point(last_[i])).squaredNorm(), i};
  }

  void add(std::size_t i) {
    is_convex_[i] = orient2d(point(last_[i]), point(i), point(next_[i])) > 0;
    if (is_convex_[i]) {
      candidates_.insert(candidate(i));
    } else {
      obstacles_.insert(i);
    }
  }

  void remove(std::size_t i) {
    if (is_convex_[i]) {
      candidates_.erase(candidate(i));
    } else {
      obstacles_.erase(i);
    }
  }

  /// Whether the ring does not enter the triangle. If it does, it has a corner there that is not convex.
  bool isEar(std::size_t at) const {
    const std::size_t last = last_[at], next = next_[at];
    return std::ranges::none_of(obstacles_, [&](std::size_t i) {
      return i != last && i != next && isIn(i, {point(last), point(at), point(next)});
    });
  }

  /// Where the ring touches a corner of the triangle, it matters where it continues.
  bool isIn(std::size_t i, const std::array<Vec2, 3>& ear) const {
    const Vec2& at = point(i);
    for (std::size_t k = 0; k < 3; ++k) {
      if (at != ear[k]) continue;
      const Vec2 &before = ear[(k + 2) % 3], &after = ear[(k + 1) % 3];
      return pointsInside(before, at, after, point(last_[i])) ||
             pointsInside(before, at, after, point(next_[i]));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (orient2d(ear[k], ear[(k + 1) % 3], at) < 0) return false;
    }
    return true;
  }

  std::span<const Vec2> points_;
  const Ring& ring_;
  std::vector<std::size_t> last_, next_;  // per corner of the ring
  std::vector<bool> is_convex_;
  std::set<std::pair<double, std::size_t>>
      candidates_;                   // convex corners, by the length of the ear's diagonal
  std::set<std::size_t> obstacles_;  // the others
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> polygonTriangles(std::span<const Vec2> points, Ring outer,
                                                           std::vector<Ring> holes) {
  const auto farthest = [&](const Ring& ring) {
    double most = points[ring.front()].x();
    for (const std::uint32_t corner : ring) most = std::max(most, points[corner].x());
    return most;
  };
  // From the right to the left, so that the bridge's other end is on the ring.
  std::ranges::stable_sort(holes, {}, farthest);
  while (!holes.empty() && !outer.empty()) {
    const Ring hole = std::move(holes.back());
    holes.pop_back();
    outer = withHole(points, outer, hole, holes);
  }
  if (outer.size() < 3) return {};
  return EarClipper(points, outer).clipAll();
}

bool encloses(std::span<const Vec2> ring, const Vec2& point) {
  bool is_inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    is_inside ^= (orient2d(a, b, point) > 0) == (b.y() > a.y());
  }
  return is_inside;
}

}  // namespace octoblisk::detail
