#include "octoblisk/solid_boundary.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "geometry/triangle_feature.h"
#include "geometry/winding_number.h"
#include "query/candidate_pairs.h"

namespace octoblisk {

using namespace detail;

namespace {

/// The only other triangle that uses the edge between two of the triangle's corners in the opposite
/// direction; none if no triangle or several triangles use the edge.
std::uint32_t neighbourAt(const Surface& surface, std::uint32_t triangle, std::uint32_t from,
                          std::uint32_t to) {
  std::uint32_t found = kNoTriangle;
  for (const std::uint32_t other : surface.star(from)) {
    if (other == triangle) continue;
    const auto& corners = surface.corners(other);
    if (std::ranges::find(corners, to) == corners.end()) continue;
    const auto at = static_cast<std::size_t>(std::ranges::find(corners, to) - corners.begin());
    if (found != kNoTriangle || corners[(at + 1) % 3] != from) return kNoTriangle;
    found = other;
  }
  return found;
}

bool shareCorner(const Surface& surface, std::uint32_t a, std::uint32_t b) {
  return std::ranges::any_of(surface.corners(a), [&](std::uint32_t corner) {
    return std::ranges::find(surface.corners(b), corner) != surface.corners(b).end();
  });
}

double angleAt(const Triangle& triangle, std::size_t corner) {
  const Vec3 to_next = triangle[(corner + 1) % 3] - triangle[corner];
  const Vec3 to_last = triangle[(corner + 2) % 3] - triangle[corner];
  return std::atan2(to_next.cross(to_last).norm(), to_next.dot(to_last));
}

}  // namespace

SolidBoundary::SolidBoundary(const Surface& surface, int threads)
    : surface_(&surface), bounds_(surface.tree().mesh().triangleCount(), 1) {
  findGoodEdges();
  findMeetings();
  whole_ = std::ranges::find(bounds_, 0) == bounds_.end();
  findRegions(threads);
}

void SolidBoundary::findGoodEdges() {
  for (std::uint32_t t = 0; t < bounds_.size(); ++t) {
    const auto& corners = surface_->corners(t);
    if (scaledNormal(surface_->tree().mesh().triangle(t)).isZero(0.0)) bounds_[t] = 0;
    for (std::size_t i = 0; i < 3 && bounds_[t] != 0; ++i) {
      if (neighbourAt(*surface_, t, corners[i], corners[(i + 1) % 3]) == kNoTriangle) bounds_[t] = 0;
    }
  }
}

void SolidBoundary::findMeetings() {
  const Tree& tree = treeOf(surface_->tree());
  forEachCandidatePair(tree, tree, Pose(), [&](const CandidatePair& pair) {
    const auto [a, b] = pair.triangles;
    if (a < b && !shareCorner(*surface_, a, b) && meet(tree, tree, Pose(), pair)) bounds_[a] = bounds_[b] = 0;
  });
}

/// Regions are connected by edges. The winding number jumps by one across a region. On the region, with the
/// triangle at the query point left out, it is 1/2 more than outside.
void SolidBoundary::findRegions(int threads) {
  const TriangleMesh& mesh = surface_->tree().mesh();
  std::vector<std::vector<std::uint32_t>> regions;
  std::vector<char> seen(bounds_.size(), 0);
  for (std::uint32_t first = 0; first < bounds_.size(); ++first) {
    if (bounds_[first] == 0 || seen[first] != 0) continue;
    std::vector<std::uint32_t> region = {first};
    seen[first] = 1;
    for (std::size_t next = 0; next < region.size(); ++next) {
      const auto corners = surface_->corners(region[next]);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t other = neighbourAt(*surface_, region[next], corners[i], corners[(i + 1) % 3]);
        if (bounds_[other] == 0 || seen[other] != 0) continue;
        seen[other] = 1;
        region.push_back(other);
      }
    }
    regions.push_back(std::move(region));
  }
  std::ranges::sort(regions, {}, [](const std::vector<std::uint32_t>& region) {
    return std::pair(~region.size(), region.front());  // largest first
  });
  constexpr std::size_t kMaxRegions = 128;
  parallelFor(regions.size(), threads, [&](std::size_t r, std::size_t) {
    bool is_boundary = false;
    if (r < kMaxRegions) {
      const std::uint32_t largest = *std::ranges::max_element(
          regions[r], {}, [&](std::uint32_t t) { return scaledNormal(mesh.triangle(t)).squaredNorm(); });
      const Triangle triangle = mesh.triangle(largest);
      const Vec3 middle = centroidOf(triangle);
      const double outside = windingNumber(mesh, middle, largest) - 0.5;
      // This value is -1/2 for a lone sheet, -1 for a region that faces inward, and 1 for one inside another
      // solid.
      constexpr double kLeast = -0.75, kMax = 0.5;
      is_boundary = outside > kLeast && outside < kMax;
    }
    if (is_boundary) return;
    for (const std::uint32_t t : regions[r]) bounds_[t] = 0;
  });
}

PointLocation SolidBoundary::locate(const Vec3& point) const {
  if (whole_) return octoblisk::locate(*surface_, point);
  const std::optional<ClosestPoint> nearest = closestPoint(surface_->tree(), point);
  return nearest ? locate(point, *nearest) : PointLocation::outside;  // farther than any mesh, or NaN
}

PointLocation SolidBoundary::locate(const Vec3& point, const ClosestPoint& nearest) const {
  if (nearest.distance == 0.0) return PointLocation::on_surface;
  if (const std::optional<Vec3> normal = pseudonormal(nearest)) {
    return normal->dot(point - nearest.point) < 0.0 ? PointLocation::inside : PointLocation::outside;
  }
  if (whole_) return octoblisk::locate(*surface_, point);
  const double winding = windingNumber(surface_->tree().mesh(), point);
  constexpr double kNear = 0.25;
  if (std::abs(winding) < kNear) return PointLocation::outside;
  return std::abs(winding - 1.0) < kNear ? PointLocation::inside : PointLocation::unknown;
}

std::optional<Vec3> SolidBoundary::pseudonormal(const ClosestPoint& at) const {
  if (bounds_[at.triangle] == 0) return std::nullopt;
  const TriangleMesh& mesh = surface_->tree().mesh();
  const Triangle triangle = mesh.triangle(at.triangle);
  const auto& corners = surface_->corners(at.triangle);
  constexpr double kOnEdge = 1e-9;  // fraction of the triangle's height
  const unsigned feature = featureOf(triangle, scaledNormal(triangle), at.point, kOnEdge);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    if (feature == (1u << i | 1u << next)) {
      const std::uint32_t other = neighbourAt(*surface_, at.triangle, corners[i], corners[next]);
      if (bounds_[other] == 0) return std::nullopt;
      return unitNormal(triangle) + unitNormal(mesh.triangle(other));
    }
    if (feature != 1u << i) continue;
    Vec3 sum = Vec3::Zero();
    for (const std::uint32_t t : surface_->star(corners[i])) {
      if (bounds_[t] == 0) return std::nullopt;
      const auto& of_t = surface_->corners(t);
      const auto corner = static_cast<std::size_t>(std::ranges::find(of_t, corners[i]) - of_t.begin());
      const Triangle beside = mesh.triangle(t);
      sum += angleAt(beside, corner) * unitNormal(beside);
    }
    return sum;
  }
  return unitNormal(triangle);
}

}  // namespace octoblisk
