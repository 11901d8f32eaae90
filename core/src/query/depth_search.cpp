#include "query/depth_search.h"

#include <algorithm>
#include <limits>

#include "geometry/triangle_pair.h"
#include "octoblisk/closest_point.h"
#include "tree/tree.h"

namespace octoblisk::detail {
namespace {

/// A point that two meeting triangles share, up to rounding.
Vec3 sharedPoint(const Triangle& a, const Triangle& b) {
  Vec3 best = closestPoints(a, b).point_on_b;
  double least = std::max(distance(a, best), distance(b, best));
  const auto tryEdges = [&](const Triangle& of, const Triangle& through) {
    const Vec3 normal = scaledNormal(through);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &from = of[i], &to = of[(i + 1) % 3];
      const double height_from = normal.dot(from - through[0]), height_to = normal.dot(to - through[0]);
      if (height_from == height_to || (height_from > 0.0) == (height_to > 0.0)) continue;
      const Vec3 point = from + (to - from) * (height_from / (height_from - height_to));
      const double off = std::max(distance(a, point), distance(b, point));
      if (off < least) {
        least = off;
        best = point;
      }
    }
  };
  tryEdges(a, b);
  tryEdges(b, a);
  return best;
}

}  // namespace

GougeDepth DepthSearch::deepest(const Surface& a, const Surface& b, const Pose& b_in_a, double tolerance,
                                const DepthsSought& sought) {
  solid_a_ = &a;
  is_whole_ = a.isWhole();
  prepare(boundaryOf(a), boundaryOf(b), b_in_a, tolerance, sought);
  findCrossings();
  if (!best_.is_known) {
    best_.gouging = Gouging::found;
    keepCrossing(crossings_.front());
  } else {
    findInside();
    search();
  }
  if (best_.triangle_a != kNoTriangle) best_.triangle_a = a.sourceOf(best_.triangle_a);
  if (best_.triangle_b != kNoTriangle) best_.triangle_b = b.sourceOf(best_.triangle_b);
  return best_;
}

void DepthSearch::prepare(const Surface& a, const Surface& b, const Pose& b_in_a, double tolerance,
                          const DepthsSought& sought) {
  for (const std::uint32_t triangle : marked_) mark_[triangle] = Mark::none;
  for (const std::uint32_t corner : indexed_) index_of_corner_[corner] = kNoIndex;
  marked_.clear();
  indexed_.clear();
  undecided_.clear();
  flat_.clear();
  crossings_.clear();
  touch_.reset();
  open_.clear();
  corners_.clear();
  met_.clear();
  parts_.clear();
  a_ = &a;
  b_ = &b;
  b_in_a_ = b_in_a;
  tolerance_ = std::max(tolerance, 1e-12 * (treeOf(a.tree()).radius() + treeOf(b.tree()).radius()));
  sought_ = sought;
  best_ = {};
  greatest_dropped_ = 0.0;
  last_nearest_ = kNoTriangle;
  if (mark_.size() < b.tree().mesh().triangleCount())
    mark_.resize(b.tree().mesh().triangleCount(), Mark::none);
  if (index_of_corner_.size() < b.cornerCount()) index_of_corner_.resize(b.cornerCount(), kNoIndex);
  component_crosses_.assign(b.componentCount(), false);
}

void DepthSearch::search() {
  if (marked_.empty()) return;
  best_.gouging = Gouging::found;
  if (touch_) keepCrossing(*touch_);
  const auto first_inside =
      std::ranges::find(marked_, Mark::inside, [&](std::uint32_t triangle) { return mark_[triangle]; });
  // Start inside: the deeper the best point, the more of the rest can be skipped.
  for (auto triangle = first_inside; triangle != marked_.end() && !isEnough(); ++triangle)
    addTriangle(*triangle, 0, 0);
  for (auto pair = crossings_.begin(); pair != crossings_.end() && !isEnough();) {
    const std::uint32_t triangle = pair->b;
    const auto met_begin = static_cast<std::uint32_t>(met_.size());
    for (; pair != crossings_.end() && pair->b == triangle; ++pair) met_.push_back(pair->a);
    addTriangle(triangle, met_begin, static_cast<std::uint32_t>(met_.size()));
  }
  while (!parts_.empty() && parts_.front().bound > limit() && !isEnough()) {
    std::ranges::pop_heap(parts_, {}, &Part::bound);
    const Part part = parts_.back();
    parts_.pop_back();
    divide(part);
  }
  if (isEnough()) {
    best_.upper_bound = std::numeric_limits<double>::infinity();
    return;
  }
  if (!parts_.empty()) greatest_dropped_ = std::max(greatest_dropped_, parts_.front().bound);
  best_.upper_bound = std::max(best_.depth, greatest_dropped_);
}

void DepthSearch::addTriangle(std::uint32_t triangle, std::uint32_t met_begin, std::uint32_t met_end) {
  Part part{{}, triangle, met_begin, met_end, 0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < 3; ++i) part.corner[i] = index_of_corner_[b_->corners(triangle)[i]];
  for (std::size_t i = 0; i < 3; ++i) {
    Corner& corner = corners_[part.corner[i]];
    if (corner.nearest != kNoTriangle) {
      keepDeeper(corner, triangle);
      continue;
    }
    for (const std::uint32_t other : part.corner) considerNear(corner, corners_[other].nearest);
    considerNear(corner, last_nearest_);
    measure(corner);
    keepDeeper(corner, triangle);
    last_nearest_ = corner.nearest;
  }
  add(part);
}

std::uint32_t DepthSearch::addCorner(std::uint32_t corner_of_b) {
  std::uint32_t& index = index_of_corner_[corner_of_b];
  if (index == kNoIndex) {
    index = static_cast<std::uint32_t>(corners_.size());
    indexed_.push_back(corner_of_b);
    corners_.emplace_back().point = b_in_a_ * b_->position(corner_of_b);
  }
  return index;
}

/// Makes the closest point on a triangle of A the corner's foot if it is closer.
void DepthSearch::considerNear(Corner& corner, std::uint32_t triangle) const {
  if (triangle == kNoTriangle || triangle == corner.nearest) return;
  const Vec3 foot = closestPoint(a_->tree().mesh().triangle(triangle), corner.point);
  const double distance = (foot - corner.point).norm();
  if (distance < corner.distance) {
    corner.foot = foot;
    corner.distance = distance;
    corner.nearest = triangle;
  }
}

/// Finds the corner's closest point on A's surface. Does nothing if the known point proves that the corner
/// exceeds the greatest depth so far by at most half the tolerance.
void DepthSearch::measure(Corner& corner) const {
  const bool has_best = best_.triangle_b != kNoTriangle;
  if (has_best && corner.distance <= deepestSoFar() + 0.5 * tolerance_) return;
  findNearest(corner);
}

void DepthSearch::findNearest(Corner& corner) const {
  corner.is_exact = true;
  if (const std::optional<ClosestPoint> found = closestPoint(a_->tree(), corner.point, corner.distance)) {
    corner.foot = found->point;
    corner.distance = found->distance;
    corner.nearest = found->triangle;
  }
}

PointLocation DepthSearch::locationOf(Corner& corner) {
  if (!corner.location) corner.location = located(corner.point);
  return *corner.location;
}

void DepthSearch::keepDeeper(Corner& corner, std::uint32_t triangle_b) {
  if (corner.location == PointLocation::outside || !corner.is_exact) return;
  const bool is_first = best_.triangle_b == kNoTriangle;
  if (!(corner.distance > best_.depth || is_first)) return;
  const PointLocation location = locationOf(corner);
  if (location == PointLocation::outside) return;
  best_.gouging = Gouging::found;
  best_.depth = corner.distance;
  best_.point_on_b = corner.point;
  best_.point_on_a = corner.foot;
  best_.triangle_a = corner.nearest;
  best_.triangle_b = triangle_b;
}

/// Starts the search from a point that both surfaces share: B's depth is at least 0.
void DepthSearch::keepCrossing(TrianglePair pair) {
  const Vec3 point =
      sharedPoint(a_->tree().mesh().triangle(pair.a), b_in_a_ * b_->tree().mesh().triangle(pair.b));
  best_.depth = 0.0;
  best_.point_on_b = best_.point_on_a = point;
  best_.triangle_a = pair.a;
  best_.triangle_b = pair.b;
}

void DepthSearch::add(Part part) {
  part.bound = boundOf(part);
  if (part.bound <= limit()) {
    greatest_dropped_ = std::max(greatest_dropped_, part.bound);
    return;
  }
  parts_.push_back(part);
  std::ranges::push_heap(parts_, {}, &Part::bound);
}

}  // namespace octoblisk::detail
