#include "octoblisk/depth.h"

#include <algorithm>
#include <limits>
#include <span>

#include "octoblisk/closest_point.h"
#include "octoblisk/collide.h"
#include "octoblisk/depth_bounds.h"
#include "octoblisk/triangle_pair.h"

namespace octoblisk {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

double distance(const Triangle& triangle, const Vec3& point) {
  return (closestPoint(triangle, point) - point).norm();
}

/// A point that two triangles that meet share, up to rounding.
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

bool apart(const Triangle& a, const Triangle& b) {
  for (int k = 0; k < 3; ++k) {
    if (std::min({a[0][k], a[1][k], a[2][k]}) > std::max({b[0][k], b[1][k], b[2][k]}) ||
        std::min({b[0][k], b[1][k], b[2][k]}) > std::max({a[0][k], a[1][k], a[2][k]})) {
      return true;
    }
  }
  return false;
}

/// How far along the segment from `point` to `other` the foot on the triangle's plane leaves the triangle;
/// 1 where it does not, 0 where it is outside already.
double leavesPrism(const Triangle& triangle, const Vec3& point, const Vec3& other) {
  const Vec3 normal = scaledNormal(triangle);
  double at = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 inward = normal.cross(triangle[(i + 1) % 3] - triangle[i]);
    const double here = inward.dot(point - triangle[i]), there = inward.dot(other - triangle[i]);
    if (there < 0.0) at = here > 0.0 ? std::min(at, here / (here - there)) : 0.0;
  }
  return at;
}

}  // namespace

GougeDepth DepthQuery::deepest(const Surface& a, const Surface& b, const Pose& b_in_a, double tolerance) {
  prepare(a, b, b_in_a, tolerance);
  if (!a.isClosed()) {
    best_.gouging = Gouging::unknown;
    return best_;
  }
  findCrossings();
  findInside();
  search();
  return best_;
}

void DepthQuery::prepare(const Surface& a, const Surface& b, const Pose& b_in_a, double tolerance) {
  for (const std::uint32_t triangle : marked_) mark_[triangle] = Mark::none;
  for (const std::uint32_t corner : known_) corner_of_b_[corner] = kNone;
  marked_.clear();
  known_.clear();
  crossings_.clear();
  open_.clear();
  corners_.clear();
  met_.clear();
  parts_.clear();
  a_ = &a;
  b_ = &b;
  b_in_a_ = b_in_a;
  tolerance_ = std::max(tolerance, 1e-12 * (a.tree().radius() + b.tree().radius()));
  best_ = {};
  greatest_dropped_ = 0.0;
  last_nearest_ = kNoTriangle;
  if (mark_.size() < b.tree().mesh().triangleCount())
    mark_.resize(b.tree().mesh().triangleCount(), Mark::none);
  if (corner_of_b_.size() < b.cornerCount()) corner_of_b_.resize(b.cornerCount(), kNone);
  part_crosses_.assign(b.partCount(), false);
}

void DepthQuery::findCrossings() {
  touchingPairs(a_->tree(), b_->tree(), b_in_a_, crossings_);
  std::ranges::sort(crossings_, {}, [](const TrianglePair& pair) { return std::pair(pair.b, pair.a); });
  for (const TrianglePair& pair : crossings_) {
    if (mark_[pair.b] == Mark::crossing) continue;
    mark_[pair.b] = Mark::crossing;
    marked_.push_back(pair.b);
    for (const std::uint32_t corner : b_->corners(pair.b)) {
      addCorner(corner);
      part_crosses_[b_->part(corner)] = true;
    }
  }
}

/// Marks the triangles of B that are wholly inside A: those that hang together with an inside corner by
/// triangles that do not cross A's surface.
void DepthQuery::findInside() {
  for (std::size_t i = 0, crossing_corners = known_.size(); i < crossing_corners; ++i) {
    const std::uint32_t corner = known_[i];
    if (corners_[corner_of_b_[corner]].side != Side::unknown) continue;
    sideOf(corners_[corner_of_b_[corner]]);
    spread(corner);
  }
  for (std::size_t part = 0; part < b_->partCount(); ++part) {
    if (part_crosses_[part]) continue;
    const std::uint32_t corner = b_->cornerOfPart(part);
    const Vec3 point = b_in_a_ * b_->position(corner);
    if (locate(*a_, point) != PointLocation::inside) continue;
    corners_[addCorner(corner)].side = Side::inside;
    spread(corner);
  }
}

/// Gives the corners that hang together with this one its side: inside all, outside only those of crossing
/// triangles, for the outside may be large and does not matter.
void DepthQuery::spread(std::uint32_t from) {
  const Side side = corners_[corner_of_b_[from]].side;
  if (side == Side::on_surface) return;  // all triangles round it cross
  open_.push_back(from);
  while (!open_.empty()) {
    const std::uint32_t corner = open_.back();
    open_.pop_back();
    for (const std::uint32_t triangle : b_->star(corner)) {
      if (mark_[triangle] == Mark::crossing) continue;
      if (side == Side::inside && mark_[triangle] == Mark::none) {
        mark_[triangle] = Mark::inside;
        marked_.push_back(triangle);
      }
      for (const std::uint32_t next : b_->corners(triangle)) {
        if (side == Side::outside && corner_of_b_[next] == kNone) continue;
        Corner& neighbour = corners_[addCorner(next)];
        if (neighbour.side != Side::unknown) continue;
        neighbour.side = side;
        open_.push_back(next);
      }
    }
  }
}

void DepthQuery::search() {
  if (marked_.empty()) return;
  best_.gouging = Gouging::found;
  if (!crossings_.empty()) keepCrossing(crossings_.front());
  const auto first_inside =
      std::ranges::find(marked_, Mark::inside, [&](std::uint32_t triangle) { return mark_[triangle]; });
  // The inside first: the deeper the best, the more of the rest need no closer look.
  for (auto triangle = first_inside; triangle != marked_.end(); ++triangle) addTriangle(*triangle, 0, 0);
  for (auto pair = crossings_.begin(); pair != crossings_.end();) {
    const std::uint32_t triangle = pair->b;
    const auto met_begin = static_cast<std::uint32_t>(met_.size());
    for (; pair != crossings_.end() && pair->b == triangle; ++pair) met_.push_back(pair->a);
    addTriangle(triangle, met_begin, static_cast<std::uint32_t>(met_.size()));
  }
  while (!parts_.empty() && parts_.front().bound > limit()) {
    std::ranges::pop_heap(parts_, {}, &Part::bound);
    const Part part = parts_.back();
    parts_.pop_back();
    divide(part);
  }
  if (!parts_.empty()) greatest_dropped_ = std::max(greatest_dropped_, parts_.front().bound);
  best_.upper_bound = std::max(best_.depth, greatest_dropped_);
}

void DepthQuery::addTriangle(std::uint32_t triangle, std::uint32_t met_begin, std::uint32_t met_end) {
  Part part{{}, triangle, met_begin, met_end, 0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < 3; ++i) part.corner[i] = corner_of_b_[b_->corners(triangle)[i]];
  for (std::size_t i = 0; i < 3; ++i) {
    Corner& corner = corners_[part.corner[i]];
    if (corner.nearest != kNoTriangle) continue;
    for (const std::uint32_t other : part.corner) considerNear(corner, corners_[other].nearest);
    considerNear(corner, last_nearest_);
    measure(corner);
    keepDeeper(corner, triangle);
    last_nearest_ = corner.nearest;
  }
  add(part);
}

std::uint32_t DepthQuery::addCorner(std::uint32_t corner_of_b) {
  std::uint32_t& index = corner_of_b_[corner_of_b];
  if (index == kNone) {
    index = static_cast<std::uint32_t>(corners_.size());
    known_.push_back(corner_of_b);
    corners_.emplace_back().point = b_in_a_ * b_->position(corner_of_b);
  }
  return index;
}

/// Takes the closest point on a triangle of A for the corner's foot if it is closer.
void DepthQuery::considerNear(Corner& corner, std::uint32_t triangle) const {
  if (triangle == kNoTriangle || triangle == corner.nearest) return;
  const Vec3 foot = closestPoint(a_->tree().mesh().triangle(triangle), corner.point);
  const double distance = (foot - corner.point).norm();
  if (distance < corner.distance) {
    corner.foot = foot;
    corner.distance = distance;
    corner.nearest = triangle;
  }
}

/// Finds the corner's closest point on A's surface, unless the one at hand shows that it is no deeper than
/// the best by more than half the tolerance.
void DepthQuery::measure(Corner& corner) const {
  const bool has_best = best_.triangle_b != kNoTriangle;
  if (has_best && corner.distance <= best_.depth + 0.5 * tolerance_) return;
  corner.is_exact = true;
  if (const std::optional<ClosestPoint> found = closestPoint(a_->tree(), corner.point, corner.distance)) {
    corner.foot = found->point;
    corner.distance = found->distance;
    corner.nearest = found->triangle;
  }
}

DepthQuery::Side DepthQuery::sideOf(Corner& corner) {
  if (corner.side == Side::unknown) {
    switch (locate(*a_, corner.point)) {
      case PointLocation::inside:
        corner.side = Side::inside;
        break;
      case PointLocation::on_surface:
        corner.side = Side::on_surface;
        break;
      default:
        corner.side = Side::outside;
    }
  }
  return corner.side;
}

void DepthQuery::keepDeeper(Corner& corner, std::uint32_t triangle_b) {
  if (corner.side == Side::outside || !corner.is_exact) return;
  const bool is_first = best_.triangle_b == kNoTriangle;
  if (!(corner.distance > best_.depth || is_first) || sideOf(corner) == Side::outside) return;
  best_ = {Gouging::found, corner.distance, 0.0, corner.point, corner.foot, corner.nearest, triangle_b};
}

/// Starts the search from a point that both surfaces share: B reaches as deep as 0 at least.
void DepthQuery::keepCrossing(TrianglePair pair) {
  const Vec3 point =
      sharedPoint(a_->tree().mesh().triangle(pair.a), b_in_a_ * b_->tree().mesh().triangle(pair.b));
  best_ = {Gouging::found, 0.0, 0.0, point, point, pair.a, pair.b};
}

void DepthQuery::add(Part part) {
  part.bound = boundOf(part);
  if (part.bound <= limit()) {
    greatest_dropped_ = std::max(greatest_dropped_, part.bound);
    return;
  }
  parts_.push_back(part);
  std::ranges::push_heap(parts_, {}, &Part::bound);
}

double DepthQuery::boundOf(const Part& part) {
  double bound = part.bound;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner& corner = corners_[part.corner[i]];
    double way = 0.0;
    for (const std::uint32_t other : part.corner) {
      way = std::max(way, (corners_[other].point - corner.point).norm());
    }
    const bool is_outside = corner.side == Side::outside;
    bound = std::min(bound, way + (!is_outside ? corner.distance : corner.is_exact ? -corner.distance : 0.0));
  }
  if (bound <= limit()) return bound;

  // Over the hull of the extremes the distance to a triangle of A is convex: below what is interpolated
  // between the extremes. So is then every mean of the distances to several triangles.
  gatherExtremes(part);
  candidates_.clear();
  distances_.clear();
  const auto boundBy = [&](std::uint32_t triangle_a) {
    if (std::ranges::find(candidates_, triangle_a) != candidates_.end()) return;
    candidates_.push_back(triangle_a);
    const Triangle triangle = a_->tree().mesh().triangle(triangle_a);
    double greatest = 0.0;
    for (const Vec3& point : extremes_) {
      distances_.push_back(distance(triangle, point));
      greatest = std::max(greatest, distances_.back());
    }
    bound = std::min(bound, greatest);
  };
  for (std::size_t i = 0; i < 3 && bound > limit(); ++i) boundBy(corners_[part.corner[i]].nearest);
  constexpr std::size_t kCandidates = 8;
  for (std::uint32_t i = part.met_begin; i < part.met_end && bound > limit(); ++i) {
    if (candidates_.size() < kCandidates) boundBy(met_[i]);
  }
  const std::size_t count = extremes_.size();
  const auto row = [&](std::size_t candidate) {
    return std::span(distances_).subspan(candidate * count, count);
  };
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    for (std::size_t j = 0; j < i && bound > limit(); ++j) bound = std::min(bound, leastMean(row(i), row(j)));
  }
  if (candidates_.size() >= 3 && count == 3 && bound > limit()) {
    bound = std::min(bound, levelMean(row(0), row(1), row(2)));
  }
  return bound;
}

/// Points whose convex hull holds all of the part that is inside A: its corners, but where they are outside,
/// the corners of its cuts with A's surface.
void DepthQuery::gatherExtremes(const Part& part) {
  extremes_.clear();
  bool is_whole = true;
  for (const std::uint32_t corner : part.corner) {
    if (corners_[corner].side == Side::outside) {
      is_whole = false;
    } else {
      extremes_.push_back(corners_[corner].point);
    }
  }
  if (is_whole) return;
  const Triangle triangle = triangleOf(part);
  for (std::uint32_t i = part.met_begin; i < part.met_end; ++i) {
    appendCut(triangle, a_->tree().mesh().triangle(met_[i]), extremes_);
  }
}

Triangle DepthQuery::triangleOf(const Part& part) const {
  return {corners_[part.corner[0]].point, corners_[part.corner[1]].point, corners_[part.corner[2]].point};
}

/// Where to cut a part: where a corner's nearest triangle ends, or another comes as near; else, and every
/// third time, halfway along the longest edge.
DepthQuery::Cut DepthQuery::cutOf(const Part& part) const {
  Cut longest{0, 0.5}, best{0, 0.5};
  double longest_edge = -1.0, best_piece = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &from = corners_[part.corner[i]], &to = corners_[part.corner[(i + 1) % 3]];
    const double length = (to.point - from.point).norm();
    if (length > longest_edge) {
      longest_edge = length;
      longest.edge = i;
    }
    if (from.nearest == to.nearest) continue;
    const auto consider = [&](double at) {
      const double piece = std::min(at, 1.0 - at) * length;
      if (std::min(at, 1.0 - at) > 0.02 && piece > best_piece) {
        best_piece = piece;
        best = {i, at};
      }
    };
    const Triangle from_nearest = a_->tree().mesh().triangle(from.nearest);
    const Triangle to_nearest = a_->tree().mesh().triangle(to.nearest);
    consider(leavesPrism(from_nearest, from.point, to.point));
    consider(1.0 - leavesPrism(to_nearest, to.point, from.point));
    const double from_excess = distance(to_nearest, from.point) - from.distance;
    const double to_excess = distance(from_nearest, to.point) - to.distance;
    if (best_piece == 0.0 && from_excess + to_excess > 0.0) consider(from_excess / (from_excess + to_excess));
  }
  return best_piece > 0.0 && part.generation % 3 != 2 ? best : longest;
}

void DepthQuery::divide(const Part& part) {
  const Cut cut = cutOf(part);
  const std::size_t next = (cut.edge + 1) % 3;
  const auto middle = static_cast<std::uint32_t>(corners_.size());
  {
    const Corner &from = corners_[part.corner[cut.edge]], &to = corners_[part.corner[next]];
    Corner between;
    between.point = from.point + cut.at * (to.point - from.point);
    considerNear(between, from.nearest);
    considerNear(between, to.nearest);
    measure(between);
    if (part.met_begin == part.met_end) between.side = Side::inside;
    corners_.push_back(between);
  }
  keepDeeper(corners_[middle], part.triangle);

  for (const std::size_t replaced : {cut.edge, next}) {
    Part half = part;
    ++half.generation;
    half.corner[replaced] = middle;
    if (part.met_begin != part.met_end) {
      const Triangle triangle = triangleOf(half);
      half.met_begin = static_cast<std::uint32_t>(met_.size());
      for (std::uint32_t i = part.met_begin; i < part.met_end; ++i) {
        const Triangle other = a_->tree().mesh().triangle(met_[i]);
        if (!apart(triangle, other) && intersects(triangle, other)) met_.push_back(met_[i]);
      }
      half.met_end = static_cast<std::uint32_t>(met_.size());
      if (half.met_begin == half.met_end) {  // all on one side
        Side side = Side::unknown;
        for (const std::uint32_t corner : half.corner) {
          const Side known = corners_[corner].side;
          if (known == Side::inside || known == Side::outside) side = known;
        }
        if (side == Side::unknown) side = sideOf(corners_[middle]);
        if (side == Side::outside) continue;
        for (const std::uint32_t corner : half.corner) {
          corners_[corner].side = side;
          keepDeeper(corners_[corner], half.triangle);
        }
      }
    }
    add(half);
  }
}

}  // namespace octoblisk
