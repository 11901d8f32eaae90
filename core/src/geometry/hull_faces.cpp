#include "octoblisk/hull_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace octoblisk {

namespace {

constexpr double kFlatHull = 1e-9;    // relative to the hull's size; a thinner hull has no good faces
constexpr double kOutside = 1e-12;    // relative to its size: points no farther out are in the face
constexpr double kSamePlane = 1e-12;  // between unit normals
constexpr std::size_t kMaxTriangles = 2 * HullFaceList::kMaxPoints;  // Euler: 2v − 4

struct HullTriangle {
  std::array<std::uint32_t, 3> corner;
  Vec3 normal;
  double offset;
  std::uint32_t face;
};

/// Extends a tetrahedron by the point that is farthest outside one of its faces, as long as there is one (C.
/// B. Barber, D. P. Dobkin, H. Huhdanpaa, The Quickhull Algorithm for Convex Hulls, 1996). Among equally far
/// points, the last one by coordinates is taken: it is a corner of the hull, never a point between two
/// others.
class HullBuilder {
 public:
  explicit HullBuilder(std::span<const Vec3> points) : points_(points) {
    for (const Vec3& point : points) size_ = std::max(size_, (point - points[0]).norm());
  }

  /// False if the points are flat or rounding has spoilt the hull.
  bool build() {
    if (!start()) return false;
    for (std::size_t t = 0; t < count_;) {
      const auto outward = [&](std::uint32_t p) { return heightOver(triangles_[t], p); };
      const std::uint32_t next = farthestBy(outward);
      if (!(outward(next) > kOutside * size_)) {
        ++t;
        continue;
      }
      if (corners_++ == HullFaceList::kMaxPoints || !add(next, t)) return false;
    }
    return count_ == 2 * corners_ - 4;
  }

  std::span<HullTriangle> triangles() { return {triangles_.data(), count_}; }
  double size() const { return size_; }

 private:
  double heightOver(const HullTriangle& triangle, std::uint32_t p) const {
    return triangle.normal.dot(points_[p]) - triangle.offset;
  }

  template <typename Measure>
  std::uint32_t farthestBy(const Measure& measure) const {
    std::uint32_t best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      const auto key = [&](std::uint32_t i) {
        return std::tuple(points_[i].x(), points_[i].y(), points_[i].z());
      };
      const double found = measure(p);
      if (found < most || (found == most && key(p) <= key(best))) continue;
      most = found;
      best = p;
    }
    return best;
  }

  bool start() {
    const std::uint32_t a = farthestBy([](std::uint32_t) { return 0.0; });
    const std::uint32_t b = farthestBy([&](std::uint32_t p) { return (points_[p] - points_[a]).norm(); });
    const Vec3 along = (points_[b] - points_[a]).normalized();
    std::uint32_t c =
        farthestBy([&](std::uint32_t p) { return along.cross(points_[p] - points_[a]).norm(); });
    const Vec3 area = along.cross(points_[c] - points_[a]);
    if (!(area.norm() > kFlatHull * size_)) return false;
    const Vec3 up = area.normalized();
    const std::uint32_t d =
        farthestBy([&](std::uint32_t p) { return std::abs(up.dot(points_[p] - points_[a])); });
    const double height = up.dot(points_[d] - points_[a]);
    if (!(std::abs(height) > kFlatHull * size_)) return false;
    corners_ = 4;
    const std::uint32_t left = height > 0.0 ? c : b, right = height > 0.0 ? b : c;
    return addTriangle(a, left, right) && addTriangle(a, right, d) && addTriangle(right, left, d) &&
           addTriangle(left, a, d);
  }

  /// False if the triangle is too thin to have a normal, or if there are too many.
  bool addTriangle(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const Vec3 first = points_[j] - points_[i], second = points_[k] - points_[i];
    const Vec3 area = first.cross(second);
    const double length = area.norm();
    if (count_ == kMaxTriangles || !(length > kFlatHull * first.norm() * second.norm())) return false;
    const Vec3 normal = area / length;
    triangles_[count_++] = {{i, j, k}, normal, normal.dot(points_[i]), 0};
    return true;
  }

  /// Replaces the triangles that the point is outside of with triangles that join their rim to the point. The
  /// first `done` triangles have no point outside; `done` becomes the number of these that stay.
  bool add(std::uint32_t point, std::size_t& done) {
    std::array<std::pair<std::uint32_t, std::uint32_t>, 3 * kMaxTriangles> rim;
    std::size_t rim_count = 0, kept = 0;
    const std::size_t were_done = done;
    for (std::size_t t = 0; t < count_; ++t) {
      if (t == were_done) done = kept;
      const HullTriangle& triangle = triangles_[t];
      if (!(heightOver(triangle, point) > kOutside * size_)) {
        triangles_[kept++] = triangle;
        continue;
      }
      for (std::size_t v = 0; v < 3; ++v) {
        const std::uint32_t from = triangle.corner[v], to = triangle.corner[(v + 1) % 3];
        const auto end = rim.begin() + static_cast<std::ptrdiff_t>(rim_count);
        const auto twin = std::find(rim.begin(), end, std::pair(to, from));
        if (twin == end) {
          rim[rim_count++] = {from, to};
        } else {
          *twin = rim[--rim_count];
        }
      }
    }
    count_ = kept;
    for (std::size_t e = 0; e < rim_count; ++e) {
      if (!addTriangle(rim[e].first, rim[e].second, point)) return false;
    }
    return true;
  }

  std::span<const Vec3> points_;
  std::array<HullTriangle, kMaxTriangles> triangles_;
  std::size_t count_ = 0, corners_ = 0;
  double size_ = 0.0;
};

/// The triangles of a hull by their edges. Each edge has one triangle on either side.
class EdgeTriangles {
 public:
  EdgeTriangles() { left_.fill(kNone); }

  /// False if rounding has given two triangles the same side of an edge.
  bool add(const HullTriangle& triangle, std::size_t index) {
    for (std::size_t v = 0; v < 3; ++v) {
      std::uint8_t& left = of(triangle.corner[v], triangle.corner[(v + 1) % 3]);
      if (left != kNone) return false;
      left = static_cast<std::uint8_t>(index);
    }
    return true;
  }

  /// The triangle on the left of an edge; none if rounding has left none.
  std::optional<std::size_t> leftOf(std::uint32_t from, std::uint32_t to) {
    const std::uint8_t left = of(from, to);
    return left == kNone ? std::nullopt : std::optional<std::size_t>(left);
  }

 private:
  static constexpr std::size_t kPoints = HullFaceList::kMaxPoints;
  static constexpr std::uint8_t kNone = 255;
  static_assert(kMaxTriangles <= kNone);

  std::uint8_t& of(std::uint32_t from, std::uint32_t to) { return left_[from * kPoints + to]; }

  std::array<std::uint8_t, kPoints * kPoints> left_;
};

}  // namespace

void HullFaceList::find(std::span<const Vec3> points) {
  faces_.clear();
  edges_.clear();
  if (points.size() < 4 || points.size() > kMaxPoints) return;
  HullBuilder hull(points);
  if (!hull.build()) return;
  for (HullTriangle& triangle : hull.triangles()) {
    const auto same = std::ranges::find_if(faces_, [&](const HullFace& face) {
      return (face.normal - triangle.normal).squaredNorm() <= kSamePlane * kSamePlane;
    });
    triangle.face = static_cast<std::uint32_t>(same - faces_.begin());
    if (same != faces_.end()) continue;
    double offset = triangle.offset;
    for (const Vec3& point : points) offset = std::max(offset, triangle.normal.dot(point));
    if (offset - triangle.offset > 10.0 * kOutside * hull.size()) return faces_.clear(), edges_.clear();
    faces_.push_back({triangle.normal, offset});
  }
  EdgeTriangles triangles;
  for (std::size_t t = 0; t < hull.triangles().size(); ++t) {
    if (!triangles.add(hull.triangles()[t], t)) return faces_.clear(), edges_.clear();
  }
  for (const HullTriangle& triangle : hull.triangles()) {
    for (std::size_t v = 0; v < 3; ++v) {
      const std::uint32_t from = triangle.corner[v], to = triangle.corner[(v + 1) % 3];
      const auto other = triangles.leftOf(to, from);
      if (!other) return faces_.clear(), edges_.clear();
      const std::uint32_t across = hull.triangles()[*other].face;
      if (from < to && across != triangle.face)
        edges_.push_back(
            {from, to, triangle.face, across, faces_[triangle.face].normal.dot(faces_[across].normal)});
    }
  }
}

}  // namespace octoblisk
