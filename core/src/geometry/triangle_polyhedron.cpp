#include "geometry/triangle_polyhedron.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/polygon.h"
#include "geometry/segment_pair.h"
#include "geometry/triangle_feature.h"

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
      : triangle_(triangle), points_(points), hull_(hull), middle_(centroidOf(triangle)) {
    for (const Vec3& corner : triangle) {
      size_ = std::max(size_, corner.cwiseAbs().maxCoeff());
      radius_ = std::max(radius_, (corner - middle_).norm());
    }
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

  Heights heightsOver(const HullFace& face) const {
    return {face.normal.dot(triangle_[0]) - face.offset, face.normal.dot(triangle_[1]) - face.offset,
            face.normal.dot(triangle_[2]) - face.offset};
  }

  bool tryFaces(double limit) {
    // The best face is usually the one over which the middle is highest. Where the middle is lower, so is the
    // lowest corner.
    std::size_t first = 0;
    for (std::size_t f = 0; f < hull_.faces.size(); ++f) {
      middle_height_[f] = hull_.faces[f].normal.dot(middle_) - hull_.faces[f].offset;
      if (middle_height_[f] > middle_height_[first]) first = f;
    }
    gap_ = std::ranges::min(heightsOver(hull_.faces[first]));
    face_ = first;
    for (std::size_t f = 0; f < hull_.faces.size() && gap_ <= limit; ++f) {
      if (!(middle_height_[f] > gap_)) continue;
      const double gap = std::ranges::min(heightsOver(hull_.faces[f]));
      if (!(gap > gap_)) continue;
      gap_ = gap;
      face_ = f;
    }
    normal_ = hull_.faces[face_].normal;
    return gap_ <= limit;
  }

  /// Prefers the triangle's own normal to an equally good face normal.
  bool tryOwnSides(double limit) {
    const Vec3 facing = scaledNormal(triangle_).normalized();
    std::size_t lowest = 0, highest = 0;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const double along = facing.dot(points_[p]);
      if (along < low) low = along, lowest = p;
      if (along > high) high = along, highest = p;
    }
    const double at = facing.dot(triangle_[0]);
    const double gap = std::max(low - at, at - high);
    if (gap > limit) return false;
    if (!(gap > gap_ - kPreferred * size_)) return true;
    gap_ = gap;
    kind_ = Kind::own_side;
    normal_ = low - at >= at - high ? Vec3(-facing) : facing;
    point_ = low - at >= at - high ? lowest : highest;
    return true;
  }

  bool tryEdges(double limit) {
    // If a corner of the triangle is below two faces, its height along an axis between their normals is at
    // most the greater of its heights over them. Few faces have a corner high enough over them, and few edges
    // have such faces.
    const double needed = std::min(gap_, 0.0) - kPreferred * size_;
    for (std::size_t f = 0; f < hull_.faces.size(); ++f) {
      highest_[f] = middle_height_[f] + radius_;
      if (!(highest_[f] > needed)) continue;
      height_[f] = heightsOver(hull_.faces[f]);
      highest_[f] = std::ranges::max(height_[f]);
    }
    std::array<std::uint32_t, kMaxHullEdges> near;
    std::size_t near_count = 0;
    for (std::uint32_t e = 0; e < hull_.edges.size(); ++e) {
      near[near_count] = e;
      near_count += std::max(highest_[hull_.edges[e].left], highest_[hull_.edges[e].right]) > needed;
    }
    return std::all_of(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(near_count),
                       [&](std::uint32_t e) { return tryEdge(e, limit, needed); });
  }

  bool tryEdge(std::uint32_t e, double limit, double needed) {
    const HullEdge& edge = hull_.edges[e];
    const auto over = [&](std::uint32_t f) {
      return highest_[f] > needed ? height_[f] : heightsOver(hull_.faces[f]);
    };
    const Heights over_left = over(edge.left), over_right = over(edge.right);
    for (std::size_t v = 0; v < 3; ++v) {
      const std::size_t next = (v + 1) % 3, opposite = (v + 2) % 3;
      // The axis perpendicular to both edges is between the two normals if these are on different sides of
      // the plane perpendicular to the triangle's edge. It separates the two only if the triangle's third
      // corner is beyond this edge.
      const double of_left = over_right[v] - over_right[next], of_right = over_left[next] - over_left[v];
      if (!(of_left * of_right > 0.0)) continue;
      const double part_left = std::abs(of_left), part_right = std::abs(of_right);
      const double scaled = part_left * over_left[v] + part_right * over_right[v];
      if (!(scaled > needed * (part_left + part_right))) continue;
      if (part_left * over_left[opposite] + part_right * over_right[opposite] < scaled) continue;
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
    const auto height = heightsOver(hull_.faces[face_]);
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
    nearest_ = points_[point_];
    const double farthest = normal_.dot(nearest_);
    const auto level = std::ranges::count_if(
        points_, [&](const Vec3& point) { return normal_.dot(point) >= farthest - kLevel * size_; });
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
  const Vec3 middle_;                                // of the triangle
  std::array<double, kMaxHullFaces> middle_height_;  // heights of the middle over the hull's faces
  double radius_ = 0.0;                              // of the triangle around its middle
  std::array<double, kMaxHullFaces> highest_;        // upper bounds of the corners' heights
  std::array<Heights, kMaxHullFaces> height_;  // valid for faces over which a corner is high enough to matter
  double size_ = 0.0;

  // The best axis so far, the features that define it, and the gap along it.
  double gap_ = -std::numeric_limits<double>::infinity();
  Vec3 normal_ = Vec3::UnitX();
  Kind kind_ = Kind::face;
  std::size_t face_ = 0, point_ = 0, corner_ = 0, edge_ = 0;
  Vec3 nearest_ = Vec3::Zero();  // the hull's point, used if none is shared
};

}  // namespace

AxisSearch searchAxes(const Triangle& triangle, std::span<const Vec3> points, const HullFaces& faces,
                      double limit) {
  return Axes(triangle, points, faces).search(limit);
}

}  // namespace octoblisk::detail
