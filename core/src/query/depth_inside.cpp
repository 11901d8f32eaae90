// The start of DepthSearch: which triangles of B meet A's surface, and which are wholly inside A.
#include <algorithm>

#include "geometry/triangle_pair.h"
#include "octoblisk/collide.h"
#include "query/candidate_pairs.h"
#include "query/depth_search.h"
#include "tree/tree.h"

namespace octoblisk::detail {

/// Finds the triangles of B that cross A's surface, and those that lie flat on a triangle of A. No point of a
/// flat triangle is deeper than the tolerance, so it is not tested against the triangles around it.
void DepthSearch::findCrossings() {
  if (findCopy()) return;
  forEachCandidatePair(treeOf(a_->tree()), treeOf(b_->tree()), b_in_a_, [this](CandidatePair pair) {
    Mark& mark = mark_[pair.triangles.b];
    if (mark == Mark::flat) return;
    if (liesOn(pair.triangles)) {
      mark = Mark::flat;
      flat_.push_back(pair.triangles);
    } else {
      (pair.meets ? crossings_ : undecided_).push_back(pair.triangles);
    }
  });
  const auto isFlat = [this](TrianglePair pair) { return mark_[pair.b] == Mark::flat; };
  std::erase_if(crossings_, isFlat);
  for (const TrianglePair& pair : undecided_) {
    if (!isFlat(pair) && meet(pair)) crossings_.push_back(pair);
  }
  std::ranges::sort(crossings_, {}, [](const TrianglePair& pair) { return std::pair(pair.b, pair.a); });
  findTouch();
  for (const TrianglePair& pair : flat_) noteBarrier(pair.b);
  for (const TrianglePair& pair : crossings_) {
    if (!boundsSolid(pair.a)) best_.is_known = false;
    if (mark_[pair.b] == Mark::crossing) continue;
    mark_[pair.b] = Mark::crossing;
    noteBarrier(pair.b);
  }
  for (const std::uint32_t triangle : marked_) {
    for (const std::uint32_t corner : b_->corners(triangle)) {
      if (mark_[triangle] == Mark::crossing || isReachable(corner)) addCorner(corner);
    }
  }
}

/// Whether B lies on a copy of itself and meets it. Then the search is done.
bool DepthSearch::findCopy() {
  const std::size_t count = b_->tree().mesh().triangleCount();
  if (a_->tree().mesh().triangleCount() != count) return false;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!liesOn({i, i})) return false;
  }
  if (!meet({0, 0})) return false;
  touch_ = {0, 0};
  marked_.push_back(0);
  component_crosses_.assign(component_crosses_.size(), true);
  return true;
}

/// Finds a pair that meets. If no pair meets, each flat triangle of B lies wholly on one side of A's surface,
/// like B's other triangles.
void DepthSearch::findTouch() {
  if (!crossings_.empty()) {
    touch_ = crossings_.front();
  } else if (!flat_.empty()) {
    const auto touching = std::ranges::find_if(flat_, [this](TrianglePair pair) { return meet(pair); });
    touch_ = touching != flat_.end() ? std::optional(*touching) : collide(a_->tree(), b_->tree(), b_in_a_);
    if (touch_) return;
    for (const TrianglePair& pair : flat_) mark_[pair.b] = Mark::none;
    flat_.clear();
  }
}

bool DepthSearch::meet(TrianglePair pair) const {
  return intersects(a_->tree().mesh(), b_->tree().mesh(), b_in_a_, pair);
}

/// Whether the triangle of B is within the tolerance of the triangle of A. The distance to a triangle is
/// convex, so it is greatest at a corner.
bool DepthSearch::liesOn(TrianglePair pair) {
  if (!boundsSolid(pair.a)) return false;
  const Triangle on = a_->tree().mesh().triangle(pair.a);
  double greatest = 0.0;
  for (const Vec3& corner : b_->tree().mesh().triangle(pair.b)) {
    const double distance = octoblisk::distance(on, b_in_a_ * corner);
    if (!(distance <= tolerance_)) return false;  // also if it is not a number
    greatest = std::max(greatest, distance);
  }
  greatest_dropped_ = std::max(greatest_dropped_, greatest);
  return true;
}

/// Marks a triangle that the search for inside triangles does not pass.
void DepthSearch::noteBarrier(std::uint32_t triangle) {
  marked_.push_back(triangle);
  for (const std::uint32_t corner : b_->corners(triangle)) component_crosses_[b_->component(corner)] = true;
}

bool DepthSearch::isBarrier(std::uint32_t triangle) const {
  return mark_[triangle] == Mark::crossing || mark_[triangle] == Mark::flat;
}

/// Whether a triangle around the corner of B is not a barrier: the search can get to the corner by it.
bool DepthSearch::isReachable(std::uint32_t corner) const {
  return !std::ranges::all_of(b_->star(corner), [this](std::uint32_t t) { return isBarrier(t); });
}

/// Marks the triangles of B that are wholly inside A. They are connected to an inside corner by triangles
/// that do not cross A's surface.
void DepthSearch::findInside() {
  for (std::size_t i = 0, crossing_corners = indexed_.size(); i < crossing_corners; ++i) {
    const std::uint32_t corner = indexed_[i];
    if (corners_[index_of_corner_[corner]].location) continue;
    locationOf(corners_[index_of_corner_[corner]]);
    spread(corner);
  }
  for (std::size_t component = 0; component < b_->componentCount(); ++component) {
    if (component_crosses_[component]) continue;
    const std::uint32_t corner = b_->cornerOfComponent(component);
    const Vec3 point = b_in_a_ * b_->position(corner);
    if (located(point) != PointLocation::inside) continue;
    corners_[addCorner(corner)].location = PointLocation::inside;
    spread(corner);
  }
}

/// Gives this corner's location to the corners connected with it: to all of them if inside, but only to those
/// of crossing triangles if outside, because the outside may be large and does not matter. If A's surface has
/// holes, B may leave A through one, so each corner is tested.
void DepthSearch::spread(std::uint32_t from) {
  const PointLocation location = corners_[index_of_corner_[from]].location.value();
  if (location == PointLocation::on_surface) return;  // all triangles around it are barriers
  open_.push_back(from);
  while (!open_.empty()) {
    const std::uint32_t corner = open_.back();
    open_.pop_back();
    for (const std::uint32_t triangle : b_->star(corner)) {
      if (isBarrier(triangle)) continue;
      if (location == PointLocation::inside && mark_[triangle] == Mark::none) {
        mark_[triangle] = Mark::inside;
        marked_.push_back(triangle);
      }
      for (const std::uint32_t next : b_->corners(triangle)) {
        if (location == PointLocation::outside && index_of_corner_[next] == kNoIndex) continue;
        const std::uint32_t index = addCorner(next);
        Corner& neighbour = corners_[index];
        if (!neighbour.location) {
          if (is_whole_) neighbour.location = location;
          if (locationOf(neighbour) == location) open_.push_back(next);
        }
        if (!is_whole_ && neighbour.location != location && neighbour.location != PointLocation::on_surface)
          best_.is_known = false;
      }
    }
  }
}

}  // namespace octoblisk::detail
