#include "geometry/epa.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace octoblisk::detail {
namespace {

constexpr int kMaxVertices = 96;
constexpr int kMaxFaces = 2 * kMaxVertices;  // Euler: 2v − 4
constexpr double kFlat = 1e-10;      // relative to the polytope's size; anything thinner is not a polytope
constexpr double kCoplanar = 1e-12;  // relative to its size: a vertex this near to a face's plane is in it

/// A triangle of the polytope. Its normal points away from the origin.
struct PolytopeFace {
  std::array<int, 3> vertex;
  Vec3 normal;
  double distance;
};

struct Edge {
  int from, to;
};

class Polytope {
 public:
  Polytope(const Triangle& triangle, const Convex& convex) : triangle_(triangle), convex_(convex) {}

  /// Makes a tetrahedron from GJK's last simplex, without its flat part. False if the Minkowski difference is
  /// flat.
  bool start(const Simplex& simplex) {
    for (int i = 0; i < simplex.count; ++i) vertices_[static_cast<std::size_t>(count_++)] = at(simplex, i);
    for (int i = 0; i < count_; ++i) size_ = std::max(size_, point(i).norm());
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
  CorePenetration expand() {
    while (true) {
      const auto faces_end = faces_.begin() + face_count_;
      PolytopeFace& nearest = *std::min_element(
          faces_.begin(), faces_end,
          [](const PolytopeFace& a, const PolytopeFace& b) { return a.distance < b.distance; });
      const SupportPoint next = supportOfDifference(triangle_, convex_, nearest.normal);
      const double reach = next.difference.dot(nearest.normal);
      if (reach - nearest.distance <= tolerance()) return penetration(nearest);
      if (count_ == kMaxVertices) {
        nearest.distance = reach;
        return penetration(nearest);
      }
      // The face is too thin to have a good normal. Its plane, moved out to the boundary, is still a valid
      // way out.
      if (!addVertex(next, static_cast<int>(&nearest - faces_.data()))) nearest.distance = reach;
    }
  }

 private:
  static const SupportPoint& at(const Simplex& simplex, int i) {
    return simplex.point[static_cast<std::size_t>(i)];
  }
  double tolerance() const { return std::max(kFlat, convex_.precision()) * size_; }
  const Vec3& point(int i) const { return vertices_[static_cast<std::size_t>(i)].difference; }

  Vec3 areaOf(int i, int j, int k) const { return (point(j) - point(i)).cross(point(k) - point(i)); }

  /// Reduces a flat tetrahedron to its largest face, a thin face to its longest edge, and a short edge to one
  /// end.
  void dropFlat() {
    const double thin = kFlat * size_;
    const auto keep = [&](std::array<int, 3> which, int count) {
      const auto all = vertices_;
      for (std::size_t i = 0; i < 3; ++i) vertices_[i] = all[static_cast<std::size_t>(which[i])];
      count_ = count;
    };
    if (count_ == 4) {
      constexpr std::array<std::array<int, 3>, 4> kFaces = {{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
      const auto areaOfFace = [&](const std::array<int, 3>& f) { return areaOf(f[0], f[1], f[2]).norm(); };
      const auto& largest = *std::ranges::max_element(kFaces, {}, areaOfFace);
      const double volume = std::abs(areaOf(0, 1, 2).dot(point(3) - point(0)));
      if (!(volume > thin * areaOfFace(largest))) keep(largest, 3);
    }
    if (count_ == 3) {
      constexpr std::array<std::array<int, 3>, 3> kEdges = {{{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}};
      const auto lengthOf = [&](const std::array<int, 3>& e) { return (point(e[1]) - point(e[0])).norm(); };
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
      vertices_[static_cast<std::size_t>(count_)] = next;
    }
    if (!(widest > kFlat * size_)) return false;
    ++count_;
    return true;
  }

  /// False if the face would have no area.
  bool addFace(int i, int j, int k) {
    const Vec3 scaled = areaOf(i, j, k);
    const double length = scaled.norm();
    if (!(length > 0.0)) return false;
    const Vec3 normal = scaled / length;
    faces_[static_cast<std::size_t>(face_count_++)] = {{i, j, k}, normal, normal.dot(point(i))};
    return true;
  }

  /// The edges of removed faces that have no twin among them.
  struct Rim {
    std::array<Edge, 3 * kMaxFaces> edge;
    int count = 0;

    Edge* twin(const Edge& of) {
      const auto end = edge.begin() + count;
      const auto found = std::find_if(
          edge.begin(), end, [&](const Edge& other) { return other.from == of.to && other.to == of.from; });
      return found == end ? nullptr : &*found;
    }
    bool touches(const PolytopeFace& face) {
      for (std::size_t e = 0; e < 3; ++e) {
        if (twin({face.vertex[e], face.vertex[(e + 1) % 3]})) return true;
      }
      return false;
    }
    void take(const PolytopeFace& face) {
      for (std::size_t e = 0; e < 3; ++e) {
        const Edge added{face.vertex[e], face.vertex[(e + 1) % 3]};
        if (Edge* const same = twin(added)) {
          *same = edge[static_cast<std::size_t>(--count)];
        } else {
          edge[static_cast<std::size_t>(count++)] = added;
        }
      }
    }
  };

  /// Replaces the faces that see the new vertex, spreading from one that does, by faces from their rim to the
  /// vertex. Also replaces faces whose plane contains the vertex, because one of their edges in line with it
  /// would make a face without area. False, with the polytope unchanged, if rounding leaves no proper rim or
  /// makes a face without area, or if there are too many faces.
  bool addVertex(const SupportPoint& vertex, int seen_face) {
    std::array<int, kMaxFaces> seeing;  // faces that see the vertex, the replaced ones first
    int seeing_count = 0, replaced_count = 0;
    const auto seeingAt = [&](int s) -> int& { return seeing[static_cast<std::size_t>(s)]; };
    const auto faceAt = [&](int f) -> PolytopeFace& { return faces_[static_cast<std::size_t>(f)]; };
    const double coplanar = kCoplanar * size_;
    seeingAt(seeing_count++) = seen_face;
    for (int f = 0; f < face_count_; ++f) {
      const PolytopeFace& face = faceAt(f);
      if (f == seen_face || face.normal.dot(vertex.difference) < face.distance - coplanar) continue;
      seeingAt(seeing_count++) = f;
    }
    Rim rim;
    const auto replace = [&](int s) {
      rim.take(faceAt(seeingAt(s)));
      std::swap(seeingAt(s), seeingAt(replaced_count++));
    };
    replace(0);
    for (bool spreads = true; spreads;) {
      spreads = false;
      for (int s = replaced_count; s < seeing_count; ++s) {
        if (!rim.touches(faceAt(seeingAt(s)))) continue;
        replace(s);
        spreads = true;
      }
    }
    const int before = face_count_;
    if (before - replaced_count + rim.count > kMaxFaces || rim.count < 3) return false;
    vertices_[static_cast<std::size_t>(count_)] = vertex;
    for (int e = 0; e < rim.count; ++e) {
      const Edge& edge = rim.edge[static_cast<std::size_t>(e)];
      if (addFace(edge.from, edge.to, count_)) continue;
      face_count_ = before;
      return false;
    }
    ++count_;
    // The last faces fill the places of the replaced ones. In descending order, no replaced face is moved.
    std::sort(seeing.begin(), seeing.begin() + replaced_count, std::greater<>());
    for (int s = 0; s < replaced_count; ++s) faceAt(seeingAt(s)) = faceAt(--face_count_);
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
  CorePenetration penetration(const PolytopeFace& nearest) const {
    const Vec3 foot = nearest.normal * nearest.distance;
    const PolytopeFace* face = &nearest;
    Vec3 weights = Vec3(1.0, 0.0, 0.0);
    double least = std::numeric_limits<double>::infinity();
    for (int f = 0; f < face_count_; ++f) {
      const PolytopeFace& candidate = faces_[static_cast<std::size_t>(f)];
      if (candidate.distance > nearest.distance + tolerance()) continue;
      const Vec3 found = weightsOf(candidate, foot);
      if (!(found.sum() > 0.0)) continue;
      Vec3 on_face = Vec3::Zero();
      for (int corner = 0; corner < 3; ++corner) {
        on_face += found[corner] * point(candidate.vertex[static_cast<std::size_t>(corner)]);
      }
      const double squared = (on_face - foot).squaredNorm();
      if (!(squared < least)) continue;
      least = squared;
      face = &candidate;
      weights = found;
    }
    CorePenetration result;
    result.depth = std::max(nearest.distance, 0.0);
    result.normal = -nearest.normal;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const SupportPoint& vertex = vertices_[static_cast<std::size_t>(face->vertex[corner])];
      result.on_triangle += weights[static_cast<Eigen::Index>(corner)] * vertex.on_triangle;
    }
    result.on_core = result.on_triangle + result.depth * result.normal;
    return result;
  }

  const Triangle& triangle_;
  const Convex& convex_;
  std::array<SupportPoint, kMaxVertices + 1> vertices_;
  std::array<PolytopeFace, 2 * kMaxFaces> faces_;  // room for new faces beside those that they replace
  int count_ = 0;
  int face_count_ = 0;
  double size_ = 0.0;
};

}  // namespace

std::optional<CorePenetration> epa(const Triangle& triangle, const Convex& convex, const Simplex& simplex) {
  Polytope polytope(triangle, convex);
  if (!polytope.start(simplex)) return std::nullopt;
  return polytope.expand();
}

}  // namespace octoblisk::detail
