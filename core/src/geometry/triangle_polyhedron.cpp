#include "geometry/triangle_polyhedron.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/polygon.h"
#include "geometry/segment_pair.h"
#include "geometry/triangle_feature.h"
#include "octoblisk/convex.h"

namespace octoblisk::detail {
namespace {

constexpr std::size_t kMaxHullFaces = 2 * HullFaceList::kMaxPoints;
constexpr std::size_t kMaxHullEdges = 3 * HullFaceList::kMaxPoints;  // Euler: 3v − 6
constexpr double kLevel = 1e-10;      // relative to the measured size: corners this near to a plane are in it
constexpr double kPreferred = 1e-13;  // relative to it: the gain that an axis of a later kind needs

/// A search for the axis along which triangle and hull are farthest apart, or least deep in each other. Tests
/// all sides of triangle − hull: the hull's faces, the triangle's own two, and the pairs of edges whose arcs
/// on the sphere of normals cross.
class Axes {
 public:
  Axes(const Triangle& triangle, std::span<const Vec3> points, const HullFaces& hull)
      : triangle_(triangle), points_(points), hull_(hull) {
    for (const Vec3& corner : triangle) size_ = std::max(size_, corner.cwiseAbs().maxCoeff());
  }

  AxisSearch search(double limit) {
    if (!tryFaces(limit) || !tryOwnSides(limit) || !tryEdges(limit)) return {};
    const std::optional<Vec3> shared = sharedPoint();
    AxisSearch found;
    found.contact.distance = gap_;
    found.contact.normal = normal_;
    // If the two meet, the least deep axis has a point of both, whatever rounding says.
    found.verdict = shared || gap_ <= 0.0 ? AxisSearch::Verdict::contact : AxisSearch::Verdict::apart;
    found.contact.on_core = shared.value_or(nearest_);
    found.contact.on_triangle = found.contact.on_core + gap_ * normal_;
    return found;
  }

 private:
  enum class Kind { face, own_side, edges };

  using Heights = std::array<double, 3>;  // of the triangle's corners over a face

  bool tryFaces(double limit) {
    double most = 0.0;
    for (std::size_t f = 0; f < hull_.faces.size(); ++f) {
      const HullFace& face = hull_.faces[f];
      const double first = face.normal.dot(triangle_[0]) - face.offset,
                   second = face.normal.dot(triangle_[1]) - face.offset,
                   third = face.normal.dot(triangle_[2]) - face.offset;
      height_[f] = {first, second, third};
      const double gap = std::min({first, second, third}), sum = first + second + third;
      if (gap < gap_ || (gap == gap_ && sum <= most)) continue;  // of equal gaps, where most is outside
      gap_ = gap;
      most = sum;
      face_ = f;
    }
    normal_ = hull_.faces[face_].normal;
    return gap_ <= limit;
  }

  /// Prefers the triangle's own normal to an equally good face normal.
  bool tryOwnSides(double limit) {
    const Vec3 facing = unitNormal(triangle_);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& point : points_) {
      const double along = facing.dot(point);
      low = std::min(low, along);
      high = std::max(high, along);
    }
    const double at = facing.dot(triangle_[0]);
    const double gap = std::max(low - at, at - high);
    if (gap > limit) return false;
    if (!(gap > gap_ - kPreferred * size_)) return true;
    gap_ = gap;
    kind_ = Kind::own_side;
    normal_ = low - at >= at - high ? Vec3(-facing) : facing;
    return true;
  }

  bool tryEdges(double limit) {
    // If a corner of the triangle is below two faces, its height along an axis between their normals is at
    // most the greater of its heights over them. Few faces have a corner high enough over them, and few edges
    // have such faces.
    const double needed = std::min(gap_, 0.0) - kPreferred * size_;
    std::array<double, kMaxHullFaces> highest;
    for (std::size_t f = 0; f < hull_.faces.size(); ++f) {
      highest[f] = std::max({height_[f][0], height_[f][1], height_[f][2]});
    }
    std::array<std::uint32_t, kMaxHullEdges> near;
    std::size_t near_count = 0;
    for (std::uint32_t e = 0; e < hull_.edges.size(); ++e) {
      near[near_count] = e;
      near_count += std::max(highest[hull_.edges[e].left], highest[hull_.edges[e].right]) > needed;
    }
    return std::all_of(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(near_count),
                       [&](std::uint32_t e) { return tryEdge(e, limit, needed); });
  }

  bool tryEdge(std::uint32_t e, double limit, double needed) {
    const HullEdge& edge = hull_.edges[e];
    const Heights &over_left = height_[edge.left], &over_right = height_[edge.right];
    for (std::size_t v = 0; v < 3; ++v) {
      const std::size_t next = (v + 1) % 3, opposite = (v + 2) % 3;
      // The axis perpendicular to both edges is between the two normals if these are on different sides of
      // the plane perpendicular to the triangle's edge. It separates the two only if the triangle's third
      // corner is beyond this edge. Few edges pass; a branch for each condition would cost more.
      const double of_left = over_right[v] - over_right[next], of_right = over_left[next] - over_left[v];
      const double part_left = std::abs(of_left), part_right = std::abs(of_right);
      const double scaled = part_left * over_left[v] + part_right * over_right[v];
      const bool separates = (of_left * of_right > 0.0) & (scaled > needed * (part_left + part_right)) &
                             (part_left * over_left[opposite] + part_right * over_right[opposite] >= scaled);
      if (!separates) continue;
      const double squared =
          part_left * part_left + part_right * part_right + 2.0 * part_left * part_right * edge.cosine;
      if (!isLonger(scaled, squared, gap_ + kPreferred * size_)) continue;
      const double length = std::sqrt(squared), gap = scaled / length;
      if (gap > limit) return false;
      gap_ = gap;
      kind_ = Kind::edges;
      normal_ = (part_left * hull_.faces[edge.left].normal + part_right * hull_.faces[edge.right].normal)
                    .normalized();
      corner_ = v;
      edge_ = e;
    }
    return true;
  }

  /// Whether a number, divided by the root of a square, is above a bound.
  static bool isLonger(double number, double square, double bound) {
    const double both = bound * bound * square;
    return number > 0.0 ? bound < 0.0 || number * number > both : bound < 0.0 && number * number < both;
  }

  /// A point of the hull that the triangle shares with it after a translation by the gap. If there is one, it
  /// is one of the closest or deepest points.
  std::optional<Vec3> sharedPoint() {
    switch (kind_) {
      case Kind::face:
        return sharedWithFace();
      case Kind::own_side:
        return sharedWithOwnSide();
      case Kind::edges:
        break;
    }
    return sharedByEdges();
  }

  bool isInHull(const Vec3& point) const {
    return std::ranges::all_of(hull_.faces, [&](const HullFace& face) {
      return face.normal.dot(point) - face.offset <= kLevel * size_;
    });
  }

  std::optional<Vec3> sharedWithFace() {
    const Heights& height = height_[face_];
    std::size_t level = 0, lowest = 0;
    for (std::size_t v = 0; v < 3; ++v) {
      level += height[v] <= gap_ + kLevel * size_;
      if (height[v] < height[lowest]) lowest = v;
    }
    nearest_ = triangle_[lowest] - gap_ * normal_;
    if (level > 1) return middleShared();
    return isInHull(nearest_) ? std::optional(nearest_) : std::nullopt;
  }

  std::optional<Vec3> sharedWithOwnSide() {
    nearest_ = farthest(points_, normal_);
    const double highest = normal_.dot(nearest_);
    const auto level = std::ranges::count_if(
        points_, [&](const Vec3& point) { return normal_.dot(point) >= highest - kLevel * size_; });
    if (level > 1) return middleShared();
    return isOver(triangle_, scaledNormal(triangle_), nearest_) ? std::optional(nearest_) : std::nullopt;
  }

  std::optional<Vec3> sharedByEdges() {
    const HullEdge& edge = hull_.edges[edge_];
    PointPair closest;
    closestOnSegments(triangle_[corner_] - gap_ * normal_, triangle_[(corner_ + 1) % 3] - gap_ * normal_,
                      points_[edge.from], points_[edge.to], closest);
    nearest_ = closest.on_b;
    const double tolerance = kLevel * size_;
    return closest.squared_distance <= tolerance * tolerance ? std::optional(nearest_) : std::nullopt;
  }

  /// The middle of the common area of a triangle and a hull that lie along each other.
  std::optional<Vec3> middleShared() const {
    Triangle moved = triangle_;
    for (Vec3& corner : moved) corner -= gap_ * normal_;
    Polygon<3 + kMaxHullFaces> shared(moved);
    for (const HullFace& face : hull_.faces) {
      shared.cut([&](const Vec3& point) { return kLevel * size_ + face.offset - face.normal.dot(point); });
    }
    if (shared.corners().empty()) return std::nullopt;
    Vec3 sum = Vec3::Zero();
    for (const Vec3& corner : shared.corners()) sum += corner;
    return sum / static_cast<double>(shared.corners().size());
  }

  const Triangle& triangle_;
  const std::span<const Vec3> points_;
  const HullFaces& hull_;
  std::array<Heights, kMaxHullFaces> height_;  // over each face
  double size_ = 0.0;                          // the largest coordinate of the triangle

  // The best axis so far, the features that define it, and the gap along it.
  double gap_ = -std::numeric_limits<double>::infinity();
  Vec3 normal_ = Vec3::UnitX();
  Kind kind_ = Kind::face;
  std::size_t face_ = 0, corner_ = 0, edge_ = 0;
  Vec3 nearest_ = Vec3::Zero();  // the hull's point, used if none is shared
};

}  // namespace

bool canSearchAxes(std::span<const Vec3> points, const HullFaces& faces) {
  return !faces.empty() && points.size() <= HullFaceList::kMaxPoints && faces.faces.size() <= kMaxHullFaces &&
         faces.edges.size() <= kMaxHullEdges;
}

AxisSearch searchAxes(const Triangle& triangle, std::span<const Vec3> points, const HullFaces& faces,
                      double limit) {
  return Axes(triangle, points, faces).search(limit);
}

}  // namespace octoblisk::detail
