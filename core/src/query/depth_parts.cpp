// The parts of triangles that DepthSearch examines: how deep a part may be, and how it is divided.
#include <algorithm>
#include <span>

#include "geometry/bounding_box.h"
#include "geometry/triangle_pair.h"
#include "octoblisk/triangles_in_box.h"
#include "query/depth_bounds.h"
#include "query/depth_search.h"

namespace octoblisk::detail {
namespace {

bool areMeeting(const Triangle& a, const Triangle& b) {
  return boundsOf(a).meets(boundsOf(b)) && intersects(a, b);
}

/// How far along the segment from `point` to `other` the foot on the triangle's plane leaves the triangle; 1
/// if it does not, 0 if it is already outside.
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

double DepthSearch::boundOf(const Part& part) {
  double bound = part.bound;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner& corner = corners_[part.corner[i]];
    double way = 0.0;
    for (const std::uint32_t other : part.corner) {
      way = std::max(way, (corners_[other].point - corner.point).norm());
    }
    const bool is_outside = corner.location == PointLocation::outside;
    if (!is_whole_) {                                     // sides may change where A has no surface
      if (!is_outside && !boundsSolid(corner.nearest)) {  // nothing bounds the depths of parts here
        best_.is_known = false;
        return 0.0;
      }
      bound = std::min(bound, way + corner.distance);
      continue;
    }
    bound = std::min(bound, way + (!is_outside ? corner.distance : corner.is_exact ? -corner.distance : 0.0));
  }
  if (bound <= limit()) return bound;

  // Over the hull of the extremes, the distance to a triangle of A is convex: it is at most the interpolation
  // between the extremes. The same holds for every mean of the distances to several triangles.
  gatherExtremes(part);
  candidates_.clear();
  distances_.clear();
  const auto boundBy = [&](std::uint32_t triangle_a) {
    if (!boundsSolid(triangle_a) || std::ranges::find(candidates_, triangle_a) != candidates_.end()) return;
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
  if (bound > limit()) bound = std::min(bound, boundByMovingOut(part));
  return bound;
}

/// Moves the part by the limit, in the direction in which its deepest corner is nearest to A's surface. If
/// the moved part is entirely outside A, each of its points has passed the surface, so none is deeper than
/// the limit. A part that lies along many triangles of A therefore need not be divided at their edges.
double DepthSearch::boundByMovingOut(const Part& part) {
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  if (!is_whole_) return kUnbounded;  // the part may move through a hole
  const TriangleMesh& mesh = a_->tree().mesh();
  Vec3 out = part.met_begin != part.met_end ? unitNormal(mesh.triangle(met_[part.met_begin])) : Vec3::Zero();
  double greatest = 0.0;
  for (const std::uint32_t index : part.corner) {
    const Corner& corner = corners_[index];
    if (corner.location == PointLocation::outside || corner.distance < greatest) continue;
    greatest = corner.distance;
    out = greatest > tolerance_ ? ((corner.foot - corner.point) / greatest)
                                : unitNormal(mesh.triangle(corner.nearest));
  }
  Triangle moved = triangleOf(part);
  for (Vec3& point : moved) point += limit() * out;
  return isOutside(moved) ? limit() : kUnbounded;
}

/// Whether the whole triangle is outside A.
bool DepthSearch::isOutside(const Triangle& triangle) const {
  const Vec3 along = (triangle[1] - triangle[0]).normalized();
  const Vec3 normal = along.cross(triangle[2] - triangle[0]).normalized();
  Mat3 axes;
  axes << along, normal.cross(along), normal;
  if (!axes.allFinite()) return false;  // the triangle is a needle
  const Obb box = boundingBox(triangle, axes);
  const bool meets = forEachTriangleIn(a_->tree(), box, 0.0, [&](std::uint32_t triangle_a) {
    const Triangle other = a_->tree().mesh().triangle(triangle_a);
    return areMeeting(triangle, other);
  });
  return !meets && located(triangle[0]) == PointLocation::outside;
}

/// Points whose convex hull contains everything of the part that is inside A: its corners that are not
/// outside, and, if some are, the corners of its intersections with A's surface.
void DepthSearch::gatherExtremes(const Part& part) {
  extremes_.clear();
  bool is_whole = true;
  for (const std::uint32_t corner : part.corner) {
    if (corners_[corner].location == PointLocation::outside) {
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

Triangle DepthSearch::triangleOf(const Part& part) const {
  return {corners_[part.corner[0]].point, corners_[part.corner[1]].point, corners_[part.corner[2]].point};
}

/// Where to cut a part: where a corner's nearest triangle ends or another becomes as near. Otherwise, and
/// every third time, and always after many cuts, halfway along the longest edge, which produces no needles.
DepthSearch::Cut DepthSearch::cutOf(const Part& part) const {
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
  constexpr int kOften = 8;
  return best_piece > 0.0 && part.generation < kOften && part.generation % 3 != 2 ? best : longest;
}

void DepthSearch::divide(const Part& part) {
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
    if (part.met_begin == part.met_end) between.location = PointLocation::inside;
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
        if (areMeeting(triangle, other)) met_.push_back(met_[i]);
      }
      half.met_end = static_cast<std::uint32_t>(met_.size());
      if (half.met_begin == half.met_end) {  // the half is on one side
        std::optional<PointLocation> location;
        for (const std::uint32_t corner : half.corner) {
          const auto known = corners_[corner].location;
          if (known != PointLocation::inside && known != PointLocation::outside) continue;
          if (location && location != known) best_.is_known = false;  // passes through a hole
          location = known;
        }
        if (!location) {  // the corner farthest from the surface shows the side
          for (const std::uint32_t corner : half.corner) findNearest(corners_[corner]);
          const auto distanceOf = [&](std::uint32_t corner) { return corners_[corner].distance; };
          location = locationOf(corners_[*std::ranges::max_element(half.corner, {}, distanceOf)]);
        }
        if (location == PointLocation::outside) continue;
        for (const std::uint32_t corner : half.corner) {
          corners_[corner].location = location;
          keepDeeper(corners_[corner], half.triangle);
        }
      }
    }
    add(half);
  }
}

}  // namespace octoblisk::detail
