#include "octoblisk/hull_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace octoblisk {

namespace {

constexpr double kFlatHull = 1e-9;  // relative to the hull's size; a thinner hull has no good faces
constexpr double kOutside = 1e-12;  // relative to its size: points no farther out are in the face
constexpr std::size_t kMaxTriangles = 2 * HullFaceList::kMaxPoints;  // Euler: 2v − 4

struct DirectedEdge {
  std::uint32_t from, to;
};

struct HullTriangle {
  static constexpr std::uint32_t kNoFace = ~0u;

  std::array<DirectedEdge, 3> edges() const {
    return {{{corner[0], corner[1]}, {corner[1], corner[2]}, {corner[2], corner[0]}}};
  }

  std::array<std::uint32_t, 3> corner;
  Vec3 normal;
  double offset;
  std::uint32_t face;
};

/// A number below 255 for each directed edge.
class EdgeNumbers {
 public:
  static constexpr std::uint8_t kNone = 255;
  static_assert(kMaxTriangles <= kNone);

  EdgeNumbers() { numbers_.fill(kNone); }
  std::uint8_t& of(std::uint32_t from, std::uint32_t to) {
    return numbers_[from * HullFaceList::kMaxPoints + to];
  }

 private:
  std::array<std::uint8_t, HullFaceList::kMaxPoints * HullFaceList::kMaxPoints> numbers_;
};

/// Extends a tetrahedron by the point that is farthest outside one of its faces, as long as there is one (C.
/// B. Barber, D. P. Dobkin, H. Huhdanpaa, The Quickhull Algorithm for Convex Hulls, 1996). Among equally far
/// points, the last one by coordinates is taken: it is a corner of the hull, never a point between two
/// others.
class HullBuilder {
 public:
  explicit HullBuilder(std::span<const Vec3> points) : points_(points) {
    for (const Vec3& point : points) {
      size_ = std::max(size_, (point - points[0]).norm());
      rest_[rest_count_] = static_cast<std::uint32_t>(rest_count_);
      ++rest_count_;
    }
  }

  /// False if the points are flat or rounding has spoilt the hull.
  bool build() {
    if (!start()) return false;
    for (std::size_t t = 0; t < count_;) {
      const HullTriangle& triangle = triangles_[t];
      const auto [height, next] =
          farthestBy([&](const Vec3& point) { return triangle.normal.dot(point) - triangle.offset; });
      if (!(height > kOutside * size_)) {
        ++t;
      } else if (!add(takeCorner(next), t)) {
        return false;
      }
    }
    return count_ == 2 * (points_.size() - rest_count_) - 4;
  }

  std::span<HullTriangle> triangles() { return {triangles_.data(), count_}; }
  double size() const { return size_; }

 private:
  struct Farthest {
    double measure;
    std::size_t place;  // in rest_
  };

  /// Of the points that are not corners yet.
  template <typename Measure>
  Farthest farthestBy(const Measure& measure) const {
    Farthest best = {-std::numeric_limits<double>::infinity(), 0};
    for (std::size_t place = 0; place < rest_count_; ++place) {
      const Vec3& point = points_[rest_[place]];
      const double found = measure(point);
      if (found > best.measure ||
          (found == best.measure && std::ranges::lexicographical_compare(points_[rest_[best.place]], point)))
        best = {found, place};
    }
    return best;
  }

  std::uint32_t takeCorner(std::size_t place) {
    const std::uint32_t corner = rest_[place];
    rest_[place] = rest_[--rest_count_];
    return corner;
  }

  bool start() {
    const auto take = [&](auto&& measure) { return takeCorner(farthestBy(measure).place); };
    const std::uint32_t a = take([](const Vec3&) { return 0.0; });
    const std::uint32_t b = take([&](const Vec3& point) { return (point - points_[a]).norm(); });
    const Vec3 along = (points_[b] - points_[a]).normalized();
    const std::uint32_t c = take([&](const Vec3& point) { return along.cross(point - points_[a]).norm(); });
    const Vec3 area = along.cross(points_[c] - points_[a]);
    if (!(area.norm() > kFlatHull * size_)) return false;
    const Vec3 up = area.normalized();
    const std::uint32_t d = take([&](const Vec3& point) { return std::abs(up.dot(point - points_[a])); });
    const double height = up.dot(points_[d] - points_[a]);
    if (!(std::abs(height) > kFlatHull * size_)) return false;
    const std::uint32_t left = height > 0.0 ? c : b, right = height > 0.0 ? b : c;
    return addTriangle(a, left, right) && addTriangle(a, right, d) && addTriangle(right, left, d) &&
           addTriangle(left, a, d);
  }

  /// False if the triangle is too thin to have a normal, or if there are too many.
  bool addTriangle(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const Vec3 first = points_[j] - points_[i], second = points_[k] - points_[i];
    const Vec3 area = first.cross(second);
    const double squared = area.squaredNorm();
    if (count_ == kMaxTriangles ||
        !(squared > kFlatHull * kFlatHull * first.squaredNorm() * second.squaredNorm())) {
      return false;
    }
    const Vec3 normal = area / std::sqrt(squared);
    triangles_[count_++] = {{i, j, k}, normal, normal.dot(points_[i]), HullTriangle::kNoFace};
    return true;
  }

  /// Replaces the triangles that the point is outside of with triangles that join their rim to the point. The
  /// first `done` triangles have no point outside; `done` becomes the number of these that stay.
  bool add(std::uint32_t point, std::size_t& done) {
    std::size_t removed = 0, kept = 0;
    const std::size_t were_done = done;
    for (std::size_t t = 0; t < count_; ++t) {
      if (t == were_done) done = kept;
      const HullTriangle& triangle = triangles_[t];
      if (triangle.normal.dot(points_[point]) - triangle.offset > kOutside * size_) {
        for (const DirectedEdge& edge : triangle.edges()) {
          removed_[removed++] = edge;
          removed_for_.of(edge.from, edge.to) = static_cast<std::uint8_t>(point);
        }
      } else {
        if (kept != t) triangles_[kept] = triangle;
        ++kept;
      }
    }
    count_ = kept;
    for (const auto& [from, to] : std::span(removed_).first(removed)) {
      const bool is_rim = removed_for_.of(to, from) != point;
      if (is_rim && !addTriangle(from, to, point)) return false;
    }
    return true;
  }

  std::span<const Vec3> points_;
  std::array<std::uint32_t, HullFaceList::kMaxPoints> rest_;  // the points that are not corners
  std::size_t rest_count_ = 0;
  std::array<HullTriangle, kMaxTriangles> triangles_;
  EdgeNumbers removed_for_;  // the point for which the triangle on the left of an edge was removed
  std::size_t count_ = 0;
  std::array<DirectedEdge, 3 * kMaxTriangles> removed_;  // edges of the triangles that a point removes
  double size_ = 0.0;
};

/// False if rounding has given an edge no triangle on one side, or two.
bool findNeighbors(std::span<const HullTriangle> triangles, EdgeNumbers& left_of) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const auto& [from, to] : triangles[t].edges()) {
      std::uint8_t& left = left_of.of(from, to);
      if (left != EdgeNumbers::kNone) return false;
      left = static_cast<std::uint8_t>(t);
    }
  }
  return std::ranges::all_of(triangles, [&](const HullTriangle& triangle) {
    return std::ranges::all_of(triangle.edges(), [&](const DirectedEdge& edge) {
      return left_of.of(edge.to, edge.from) != EdgeNumbers::kNone;
    });
  });
}

}  // namespace

void HullFaceList::find(std::span<const Vec3> points) {
  faces_.clear();
  edges_.clear();
  if (points.size() < 4 || points.size() > kMaxPoints) return;
  HullBuilder hull(points);
  EdgeNumbers left_of;  // the triangle on the left of an edge
  if (!hull.build() || !findNeighbors(hull.triangles(), left_of)) return;
  const auto across = [&](const DirectedEdge& edge) -> HullTriangle& {
    return hull.triangles()[left_of.of(edge.to, edge.from)];
  };
  for (HullTriangle& first : hull.triangles()) {
    if (first.face != HullTriangle::kNoFace) continue;
    double offset = first.offset;
    for (const Vec3& point : points) offset = std::max(offset, first.normal.dot(point));
    if (offset - first.offset > 10.0 * kOutside * hull.size()) return faces_.clear();
    first.face = static_cast<std::uint32_t>(faces_.size());
    faces_.push_back({first.normal, offset});
    // By the corners, because the normal of a thin triangle is inaccurate.
    const auto isInPlane = [&](std::uint32_t corner) {
      return std::abs(first.normal.dot(points[corner]) - first.offset) <= kOutside * hull.size();
    };
    std::array<const HullTriangle*, kMaxTriangles> coplanar;
    coplanar[0] = &first;
    for (std::size_t k = 0, count = 1; k < count; ++k) {
      for (const DirectedEdge& edge : coplanar[k]->edges()) {
        HullTriangle& other = across(edge);
        if (other.face != HullTriangle::kNoFace || !std::ranges::all_of(other.corner, isInPlane)) continue;
        other.face = first.face;
        coplanar[count++] = &other;
      }
    }
  }
  for (const HullTriangle& triangle : hull.triangles()) {
    for (const DirectedEdge& edge : triangle.edges()) {
      const std::uint32_t left = triangle.face, right = across(edge).face;
      if (edge.from < edge.to && left != right)
        edges_.push_back({edge.from, edge.to, left, right, faces_[left].normal.dot(faces_[right].normal)});
    }
  }
}

}  // namespace octoblisk
