#include "octoblisk/epa.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace octoblisk {
namespace {

constexpr int kMaxVertices = 96;
constexpr int kMaxFaces = 2 * kMaxVertices;  // Euler: 2v − 4
constexpr double kFlat = 1e-10;              // of the polytope's size: thinner is no polytope

/// A triangle of the polytope, its normal pointing away from the origin.
struct Face {
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

  /// Makes a tetrahedron round the origin of what GJK left; false where the difference is flat.
  bool start(const Simplex& simplex) {
    for (int i = 0; i < simplex.count; ++i) vertices_[static_cast<std::size_t>(count_++)] = at(simplex, i);
    for (int i = 0; i < count_; ++i) size_ = std::max(size_, point(i).norm());
    for (int k = 0; k < 3 && count_ < 2; ++k) addIfApart(Vec3::Unit(k)) || addIfApart(-Vec3::Unit(k));
    if (count_ == 2) {
      const Vec3 across = (point(1) - point(0)).unitOrthogonal();
      const Vec3 second = across.cross(point(1) - point(0)).normalized();
      addIfApart(across) || addIfApart(-across) || addIfApart(second) || addIfApart(-second);
    }
    if (count_ == 3) {
      const Vec3 normal = (point(1) - point(0)).cross(point(2) - point(0)).normalized();
      addIfApart(normal) || addIfApart(-normal);
    }
    if (count_ < 4) return false;
    const double volume = (point(1) - point(0)).cross(point(2) - point(0)).dot(point(3) - point(0));
    if (std::abs(volume) <= kFlat * size_ * size_ * size_) return false;
    if (volume > 0.0) std::swap(vertices_[1], vertices_[2]);
    return addFace(0, 1, 2) && addFace(0, 2, 3) && addFace(0, 3, 1) && addFace(1, 3, 2);
  }

  /// Grows the polytope until its face nearest to the origin lies on the difference's boundary.
  CorePenetration expand() {
    while (true) {
      const Face nearest =
          *std::ranges::min_element(faces_.begin(), faces_.begin() + face_count_, {}, &Face::distance);
      const SupportPoint next = supportOfDifference(triangle_, convex_, nearest.normal);
      const double gain = next.difference.dot(nearest.normal) - nearest.distance;
      if (gain <= tolerance() || count_ == kMaxVertices || !addVertex(next)) return penetration(nearest);
    }
  }

 private:
  static const SupportPoint& at(const Simplex& simplex, int i) {
    return simplex.point[static_cast<std::size_t>(i)];
  }
  double tolerance() const { return std::max(kFlat, convex_.precision()) * size_; }
  const Vec3& point(int i) const { return vertices_[static_cast<std::size_t>(i)].difference; }

  /// Adds the support point in a direction where it widens the simplex by a dimension.
  bool addIfApart(const Vec3& direction) {
    const SupportPoint next = supportOfDifference(triangle_, convex_, direction);
    const double width = std::abs((next.difference - point(0)).dot(direction));
    size_ = std::max(size_, next.difference.norm());
    if (width <= kFlat * size_) return false;
    vertices_[static_cast<std::size_t>(count_++)] = next;
    return true;
  }

  bool addFace(int i, int j, int k) {
    if (face_count_ == kMaxFaces) return false;
    const Vec3 scaled = (point(j) - point(i)).cross(point(k) - point(i));
    const double length = scaled.norm();
    if (!(length > 0.0)) return false;
    const Vec3 normal = scaled / length;
    faces_[static_cast<std::size_t>(face_count_++)] = {{i, j, k}, normal, normal.dot(point(i))};
    return true;
  }

  /// Replaces the faces that see the new vertex by faces from their rim to it. False, and unchanged, where
  /// rounding leaves no proper rim.
  bool addVertex(const SupportPoint& vertex) {
    std::array<Face, kMaxFaces> kept;
    std::array<Edge, 3 * kMaxFaces> rim;
    int kept_count = 0, rim_count = 0;
    for (int f = 0; f < face_count_; ++f) {
      const Face& face = faces_[static_cast<std::size_t>(f)];
      if (face.normal.dot(vertex.difference) <= face.distance) {
        kept[static_cast<std::size_t>(kept_count++)] = face;
        continue;
      }
      for (std::size_t e = 0; e < 3; ++e) {  // an edge between two seen faces comes once each way
        const Edge edge{face.vertex[e], face.vertex[(e + 1) % 3]};
        const auto end = rim.begin() + rim_count;
        const auto twin = std::find_if(rim.begin(), end, [&](const Edge& other) {
          return other.from == edge.to && other.to == edge.from;
        });
        if (twin == end) {
          rim[static_cast<std::size_t>(rim_count++)] = edge;
        } else {
          *twin = rim[static_cast<std::size_t>(--rim_count)];
        }
      }
    }
    if (kept_count + rim_count > kMaxFaces || rim_count < 3) return false;
    const auto before = faces_;
    const int before_count = face_count_;
    vertices_[static_cast<std::size_t>(count_++)] = vertex;
    faces_ = kept;
    face_count_ = kept_count;
    for (int e = 0; e < rim_count; ++e) {
      const Edge& edge = rim[static_cast<std::size_t>(e)];
      if (addFace(edge.from, edge.to, count_ - 1)) continue;
      faces_ = before;
      face_count_ = before_count;
      --count_;
      return false;
    }
    return true;
  }

  /// The barycentric coordinates of the origin's foot on a face; negative where it lies beyond an edge.
  Vec3 weightsOfFoot(const Face& face) const {
    const auto& [i, j, k] = face.vertex;
    const Vec3 foot = face.normal * face.distance;
    const Vec3 a = point(i) - foot, b = point(j) - foot, c = point(k) - foot;
    const Vec3 areas(b.cross(c).dot(face.normal), c.cross(a).dot(face.normal), a.cross(b).dot(face.normal));
    return areas / areas.sum();
  }

  /// The origin's foot on the nearest face, as points of triangle and core. A flat side of the difference is
  /// made of several faces in one plane: the foot is on one of them.
  CorePenetration penetration(const Face& nearest) const {
    const Face* face = nullptr;
    Vec3 weights = Vec3::Constant(-std::numeric_limits<double>::infinity());
    for (int f = 0; f < face_count_; ++f) {
      const Face& candidate = faces_[static_cast<std::size_t>(f)];
      if (candidate.distance > nearest.distance + tolerance()) continue;
      const Vec3 found = weightsOfFoot(candidate);
      if (face && !(found.minCoeff() > weights.minCoeff())) continue;
      face = &candidate;
      weights = found;
    }
    weights = weights.cwiseMax(0.0);
    weights /= weights.sum();
    CorePenetration result;
    result.depth = std::max(face->distance, 0.0);
    result.normal = -face->normal;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const SupportPoint& vertex = vertices_[static_cast<std::size_t>(face->vertex[corner])];
      result.on_triangle += weights[static_cast<Eigen::Index>(corner)] * vertex.on_triangle;
      result.on_core += weights[static_cast<Eigen::Index>(corner)] * vertex.on_core;
    }
    return result;
  }

  const Triangle& triangle_;
  const Convex& convex_;
  std::array<SupportPoint, kMaxVertices + 1> vertices_;
  std::array<Face, kMaxFaces> faces_;
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

}  // namespace octoblisk
