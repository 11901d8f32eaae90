#include "geometry/epa.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace octoblisk::detail {
namespace {

constexpr std::size_t kMaxVertices = 96;
constexpr std::size_t kMaxFaces = 2 * kMaxVertices;  // Euler: 2v − 4
static_assert(kMaxFaces <= 256);                     // an index of a face is a byte
constexpr double kFlat = 1e-10;      // relative to the polytope's size; anything thinner is not a polytope
constexpr double kCoplanar = 1e-12;  // relative to its size: a vertex this near to a face's plane is in it

/// A triangle of the polytope. Its normal points away from the origin.
struct PolytopeFace {
  std::array<std::size_t, 3> vertex;
  Vec3 normal;
  double distance;
};

struct Edge {
  std::size_t from, to;
};

class Polytope {
 public:
  Polytope(const Triangle& triangle, const Convex& convex) : triangle_(triangle), convex_(convex) {}

  /// Makes a tetrahedron from GJK's last simplex, without its flat part. False if the Minkowski difference is
  /// flat.
  bool start(const Simplex& simplex) {
    for (std::size_t i = 0; i < simplex.count; ++i) vertices_[count_++] = simplex.point[i];
    for (std::size_t i = 0; i < count_; ++i) size_ = std::max(size_, point(i).norm());
    dropFlat();
    for (int k = 0; k < 3 && count_ < 2; ++k) addIfApart(Vec3::Unit(k));
    if (count_ == 2) {
      const Vec3 across = (point(1) - point(0)).unitOrthogonal();
      addIfApart(across) || addIfApart(across.cross(point(1) - point(0)).normalized());
    }
    if (count_ == 3) addIfApart(areaOf(0, 1, 2).normalized());
    if (count_ < 4) return false;
    if (areaOf(0, 1, 2).dot(point(3) - point(0)) > 0.0) std::swap(vertices_[1], vertices_[2]);
    return addFace(0, 1, 2) && addFace(0, 2, 3) && addFace(0, 3, 1) && addFace(1, 3, 2);
  }

  /// Grows the polytope until its face nearest to the origin lies on the boundary of the difference.
  CoreContact expand() {
    while (true) {
      PolytopeFace& nearest =
          *std::ranges::min_element(std::span(faces_).first(face_count_), {}, &PolytopeFace::distance);
      const SupportPoint next = supportOfDifference(triangle_, convex_, nearest.normal);
      const double reach = next.difference.dot(nearest.normal);
      if (reach - nearest.distance <= tolerance()) return penetration(nearest);
      if (count_ == kMaxVertices) {
        nearest.distance = reach;
        return penetration(nearest);
      }
      // The face is too thin to have a good normal. Its plane, moved out to the boundary, is still a valid
      // way out.
      if (!addVertex(next, static_cast<std::size_t>(&nearest - faces_.data()))) nearest.distance = reach;
    }
  }

 private:
  double tolerance() const { return std::max(kFlat, convex_.precision()) * size_; }
  const Vec3& point(std::size_t i) const { return vertices_[i].difference; }

  Vec3 areaOf(std::size_t i, std::size_t j, std::size_t k) const {
    return (point(j) - point(i)).cross(point(k) - point(i));
  }

  /// Reduces a flat tetrahedron to its largest face, a thin face to its longest edge, and a short edge to one
  /// end.
  void dropFlat() {
    const double thin = kFlat * size_;
    const auto keep = [&](std::array<std::size_t, 3> which, std::size_t count) {
      const auto all = vertices_;
      for (std::size_t i = 0; i < 3; ++i) vertices_[i] = all[which[i]];
      count_ = count;
    };
    if (count_ == 4) {
      constexpr std::array<std::array<std::size_t, 3>, 4> kFaces = {
          {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
      const auto areaOfFace = [&](const std::array<std::size_t, 3>& f) {
        return areaOf(f[0], f[1], f[2]).norm();
      };
      const auto& largest = *std::ranges::max_element(kFaces, {}, areaOfFace);
      const double volume = std::abs(areaOf(0, 1, 2).dot(point(3) - point(0)));
      if (!(volume > thin * areaOfFace(largest))) keep(largest, 3);
    }
    if (count_ == 3) {
      constexpr std::array<std::array<std::size_t, 3>, 3> kEdges = {{{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}};
      const auto lengthOf = [&](const std::array<std::size_t, 3>& e) {
        return (point(e[1]) - point(e[0])).norm();
      };
      const auto& longest = *std::ranges::max_element(kEdges, {}, lengthOf);
      if (!(areaOf(0, 1, 2).norm() > thin * lengthOf(longest))) keep(longest, 2);
    }
    if (count_ == 2 && !((point(1) - point(0)).norm() > thin)) count_ = 1;
  }

  /// Adds the support point along a unit direction or its opposite, whichever widens the simplex more. False
  /// if neither does.
  bool addIfApart(const Vec3& direction) {
    double widest = 0.0;
    for (const double sense : {1.0, -1.0}) {
      const SupportPoint next = supportOfDifference(triangle_, convex_, sense * direction);
      const double width = std::abs((next.difference - point(0)).dot(direction));
      size_ = std::max(size_, next.difference.norm());
      if (!(width > widest)) continue;
      widest = width;
      vertices_[count_] = next;
    }
    if (!(widest > kFlat * size_)) return false;
    ++count_;
    return true;
  }

  /// None if the face would have no area.
  std::optional<PolytopeFace> faceOf(std::size_t i, std::size_t j, std::size_t k) const {
    const Vec3 scaled = areaOf(i, j, k);
    const double length = scaled.norm();
    if (!(length > 0.0)) return std::nullopt;
    const Vec3 normal = scaled / length;
    return PolytopeFace{{i, j, k}, normal, normal.dot(point(i))};
  }

  static std::array<Edge, 3> edgesOf(const PolytopeFace& face) {
    const auto& [i, j, k] = face.vertex;
    return {{{i, j}, {j, k}, {k, i}}};
  }

  /// The index of the face on the left of a directed edge, as seen from outside.
  std::uint8_t& leftOf(std::size_t from, std::size_t to) { return left_of_[from][to]; }

  void setFace(std::size_t f, const PolytopeFace& face) {
    faces_[f] = face;
    for (const Edge& edge : edgesOf(face)) leftOf(edge.from, edge.to) = static_cast<std::uint8_t>(f);
  }

  bool addFace(std::size_t i, std::size_t j, std::size_t k) {
    const std::optional<PolytopeFace> face = faceOf(i, j, k);
    if (face) setFace(face_count_++, *face);
    return face.has_value();
  }

  /// Replaces the faces that see the new vertex, spreading from one that does, by faces from their rim to the
  /// vertex. Also replaces faces whose plane contains the vertex, because one of their edges in line with it
  /// would make a face without area. False, with the polytope unchanged, if rounding leaves no proper rim or
  /// makes a face without area, or if there are too many faces.
  bool addVertex(const SupportPoint& vertex, std::size_t seen_face) {
    std::array<std::size_t, kMaxFaces> replaced;
    std::size_t replaced_count = 0, rim_count = 0;
    std::array<bool, kMaxFaces> is_replaced{};
    std::array<PolytopeFace, kMaxVertices> added;
    std::array<bool, kMaxVertices> is_on_rim{};
    const double coplanar = kCoplanar * size_;
    const auto replace = [&](std::size_t f) {
      is_replaced[f] = true;
      replaced[replaced_count++] = f;
    };
    vertices_[count_] = vertex;
    replace(seen_face);
    for (std::size_t r = 0; r < replaced_count; ++r) {
      for (const Edge& edge : edgesOf(faces_[replaced[r]])) {
        const std::size_t across = leftOf(edge.to, edge.from);
        if (is_replaced[across]) continue;
        if (faces_[across].normal.dot(vertex.difference) >= faces_[across].distance - coplanar) {
          replace(across);
          continue;
        }
        const std::optional<PolytopeFace> face = faceOf(edge.from, edge.to, count_);
        bool& was_on_rim = is_on_rim[edge.from];
        if (!face || was_on_rim) return false;
        was_on_rim = true;
        added[rim_count++] = *face;
      }
    }
    if (face_count_ - replaced_count + rim_count > kMaxFaces || rim_count < 3) return false;
    ++count_;
    for (std::size_t e = 0; e < rim_count; ++e) {
      setFace(e < replaced_count ? replaced[e] : face_count_++, added[e]);
    }
    // The last faces fill the places that are left. In descending order, no replaced face is moved.
    std::ranges::sort(std::span(replaced).first(replaced_count).subspan(std::min(rim_count, replaced_count)),
                      std::greater<>());
    for (std::size_t r = rim_count; r < replaced_count; ++r) {
      const std::size_t last = --face_count_, place = replaced[r];
      if (place != last) setFace(place, faces_[last]);
    }
    return true;
  }

  /// Weights of a face's corners for its point near `foot`, a point in its plane. All are 0 for a face that
  /// is only an edge; its neighbours contain the point as well.
  Vec3 weightsOf(const PolytopeFace& face, const Vec3& foot) const {
    const auto& [i, j, k] = face.vertex;
    const Vec3 a = point(i) - foot, b = point(j) - foot, c = point(k) - foot;
    const Vec3 areas(b.cross(c).dot(face.normal), c.cross(a).dot(face.normal), a.cross(b).dot(face.normal));
    const Vec3 inside = areas.cwiseMax(0.0);
    const double sum = inside.sum();
    return sum > 0.0 ? Vec3(inside / sum) : Vec3::Zero();
  }

  /// The origin's foot on the nearest face, as points of triangle and core. A flat side of the difference
  /// consists of several coplanar faces; the foot is on one of them.
  CoreContact penetration(const PolytopeFace& nearest) const {
    const Vec3 foot = nearest.normal * nearest.distance;
    const PolytopeFace* face = &nearest;
    Vec3 weights = Vec3(1.0, 0.0, 0.0);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < face_count_; ++f) {
      const PolytopeFace& candidate = faces_[f];
      if (candidate.distance > nearest.distance + tolerance()) continue;
      const Vec3 found = weightsOf(candidate, foot);
      if (!(found.sum() > 0.0)) continue;
      Vec3 on_face = Vec3::Zero();
      for (int corner = 0; corner < 3; ++corner) {
        on_face += found[corner] * point(candidate.vertex[corner]);
      }
      const double squared = (on_face - foot).squaredNorm();
      if (!(squared < least)) continue;
      least = squared;
      face = &candidate;
      weights = found;
    }
    CoreContact result;
    result.distance = std::min(-nearest.distance, 0.0);
    result.normal = -nearest.normal;
    for (int corner = 0; corner < 3; ++corner) {
      const SupportPoint& vertex = vertices_[face->vertex[corner]];
      result.on_triangle += weights[corner] * vertex.on_triangle;
    }
    result.on_core = result.on_triangle - result.distance * result.normal;
    return result;
  }

  const Triangle& triangle_;
  const Convex& convex_;
  std::array<SupportPoint, kMaxVertices> vertices_;
  std::array<PolytopeFace, kMaxFaces> faces_;
  std::array<std::array<std::uint8_t, kMaxVertices>, kMaxVertices>
      left_of_;  // valid for edges of the polytope
  std::size_t count_ = 0;
  std::size_t face_count_ = 0;
  double size_ = 0.0;
};

}  // namespace

std::optional<CoreContact> epa(const Triangle& triangle, const Convex& convex, const Simplex& simplex) {
  Polytope polytope(triangle, convex);
  if (!polytope.start(simplex)) return std::nullopt;
  return polytope.expand();
}

}  // namespace octoblisk::detail
