#include "query/signed_distance.h"

#include <algorithm>
#include <array>

#include "octoblisk/path_query.h"
#include "octoblisk/triangles_in_box.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

/// A point of a surface that is nearest, or equally near, to a point in its solid.
struct Foot {
  Vec3 point;
  Vec3 out;  // unit, from the point in the solid to the foot
  double distance;
  std::uint32_t triangle;
};

/// The feet of a point in the solid A whose distance is at most its depth plus the slack, nearest first.
class Feet {
 public:
  Feet(const ClusteredOctree& a, const Vec3& point, double depth, double slack) {
    Obb at;
    at.center = point;
    const double touch = 1e-12 * (treeOf(a).radius() + point.norm());
    forEachTriangleIn(a, at, depth + slack, [&](std::uint32_t index) {
      const Triangle triangle = a.mesh().triangle(index);
      const Vec3 foot = closestPoint(triangle, point);
      const double distance = (foot - point).norm();
      const Vec3 out = distance > touch ? foot - point : scaledNormal(triangle);
      if (distance <= depth + slack) insert({foot, out.normalized(), distance, index});
      return false;
    });
    // A point at an edge of a triangle beyond which the surface comes nearer is not a foot.
    std::size_t kept = 0;
    const std::array<Foot, kMax> found = feet_;
    for (std::size_t i = 0; i < count_; ++i) {
      const bool goes_on =
          std::any_of(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(i), [&](const Foot& nearer) {
            return distance(a.mesh().triangle(nearer.triangle), found[i].point) <= touch;
          });
      if (!goes_on && found[i].out.allFinite()) feet_[kept++] = found[i];
    }
    count_ = kept;
  }

  std::size_t size() const { return count_; }
  const Foot& operator[](std::size_t i) const { return feet_[i]; }

 private:
  static constexpr std::size_t kMax = 16;

  void insert(const Foot& foot) {
    if (count_ == kMax) {
      if (foot.distance >= feet_.back().distance) return;
      --count_;
    }
    std::size_t at = count_++;
    for (; at > 0 && foot.distance < feet_[at - 1].distance; --at) feet_[at] = feet_[at - 1];
    feet_[at] = foot;
  }

  std::array<Foot, kMax> feet_;
  std::size_t count_ = 0;
};

/// The directions in which a surface continues straight through one of its points: a plane within a face, a
/// line along an edge, none at a corner.
class StraightOn {
 public:
  /// `rotation` takes directions from the surface's frame to the result's.
  StraightOn(const ClusteredOctree& surface, const Vec3& point, double reach, const Mat3& rotation) {
    Obb at;
    at.center = point;
    forEachTriangleIn(surface, at, reach, [&](std::uint32_t index) {
      const Triangle triangle = surface.mesh().triangle(index);
      const Vec3 normal = unitNormal(triangle);
      if (distance(triangle, point) > reach || !normal.allFinite()) return false;
      const Vec3 along = project(rotation * normal);
      if (along.norm() > kTurn && normals_ < 3) across_.row(normals_++) = along.normalized();
      return false;
    });
  }

  /// The component of a vector along these directions.
  Vec3 project(Vec3 vector) const {
    for (int i = 0; i < normals_; ++i) vector -= across_.row(i).dot(vector) * across_.row(i).transpose();
    return vector;
  }

 private:
  static constexpr double kTurn = 1e-9;  // a surface that turns by less counts as straight
  Mat3 across_ = Mat3::Zero();           // orthonormal rows
  int normals_ = 0;
};

/// The barycentric coordinates of a point of a triangle. The triangle may be degenerate.
Vec3 barycentric(const Triangle& triangle, const Vec3& point) {
  const Vec3 first = triangle[1] - triangle[0], second = triangle[2] - triangle[0], to = point - triangle[0];
  const Vec3 normal = first.cross(second);
  const double a = first.squaredNorm(), b = second.squaredNorm(), squared = normal.squaredNorm();
  if (squared > 1e-24 * a * b) {
    const double at_first = to.cross(second).dot(normal) / squared;
    const double at_second = first.cross(to).dot(normal) / squared;
    return {1.0 - at_first - at_second, at_first, at_second};
  }
  if (a == 0.0 && b == 0.0) return Vec3::UnitX();
  if (a >= b) return {1.0 - to.dot(first) / a, to.dot(first) / a, 0.0};
  return {1.0 - to.dot(second) / b, 0.0, to.dot(second) / b};
}

/// The weighted mean of the directions to the feet that is orthogonal to the surface of the deepest point, or
/// nearly so. It exists because the point cannot move along its surface away from all feet. The depth changes
/// like the mean of the distances to the feet with these weights.
Vec3 meanWayOut(const Feet& feet, const StraightOn& straight_on) {
  Vec3 mean = Vec3::Zero();
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](std::size_t i, std::size_t j, std::size_t k) {
    const Triangle hull{straight_on.project(feet[i].out), straight_on.project(feet[j].out),
                        straight_on.project(feet[k].out)};
    const Vec3 closest = closestPoint(hull, Vec3::Zero());
    if (!(closest.norm() < least - 1e-6)) return;
    least = closest.norm();
    const Vec3 weights = barycentric(hull, closest);
    mean = weights[0] * feet[i].out + weights[1] * feet[j].out + weights[2] * feet[k].out;
  };
  // Prefer the fewest feet, and among those the nearest.
  for (std::size_t i = 0; i < feet.size(); ++i) consider(i, i, i);
  for (std::size_t i = 0; i < feet.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) consider(i, j, j);
  }
  for (std::size_t i = 0; i < feet.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) consider(i, j, k);
    }
  }
  return mean;
}

/// Sets the derivative and the normal from the derivative by translation, which acts at the point `at` of B.
void setDerivative(SignedDistance& found, const Vec3& by_translation, const Vec3& at, const Pose& b_in_a) {
  found.by_translation = by_translation;
  found.by_rotation = (at - b_in_a.translation).cross(by_translation);
  found.normal = by_translation.normalized();
}

/// The tolerance of penetration depths.
double depthTolerance(const Surface& a, const Surface& b, const SignedDistanceOptions& options) {
  const double sizes = treeOf(a.tree()).radius() + treeOf(b.tree()).radius();
  return options.tolerance > 0.0 ? std::max(options.tolerance, 1e-10 * sizes) : 1e-7 * sizes;
}

/// The signed distance of surfaces that do not meet.
SignedDistance signedDistanceOf(const Clearance& clearance, const Pose& b_in_a) {
  SignedDistance found{.distance = clearance.distance,
                       .point_on_a = clearance.point_on_a,
                       .point_on_b = clearance.point_on_b,
                       .triangle_a = clearance.triangle_a,
                       .triangle_b = clearance.triangle_b};
  const Vec3 way = found.point_on_b - found.point_on_a;
  setDerivative(found, way.normalized(), found.point_on_b, b_in_a);
  return found;
}

/// The signed distance given by B's deepest point in A, which is known to within the tolerance.
SignedDistance signedDistanceOf(const GougeDepth& of_b, const Surface& a, const Surface& b,
                                const Pose& b_in_a, double tolerance) {
  SignedDistance found{.distance = -of_b.depth,
                       .point_on_a = of_b.point_on_a,
                       .point_on_b = of_b.point_on_b,
                       .triangle_a = of_b.triangle_a,
                       .triangle_b = of_b.triangle_b};
  const double near = 64.0 * tolerance;  // the reported point is about this near to the deepest one
  const Feet feet(a.tree(), of_b.point_on_b, of_b.depth, near);
  const Pose a_in_b = b_in_a.inverse();
  const StraightOn straight_on(b.tree(), a_in_b * of_b.point_on_b, near, b_in_a.rotation);
  setDerivative(found, meanWayOut(feet, straight_on), of_b.point_on_b, b_in_a);
  return found;
}

/// The same distance with A and B exchanged: the argument is expressed in B's frame, the result in A's.
SignedDistance exchanged(const SignedDistance& of_a_in_b, const Pose& b_in_a) {
  SignedDistance found{.distance = of_a_in_b.distance,
                       .point_on_a = b_in_a * of_a_in_b.point_on_b,
                       .point_on_b = b_in_a * of_a_in_b.point_on_a,
                       .triangle_a = of_a_in_b.triangle_b,
                       .triangle_b = of_a_in_b.triangle_a};
  setDerivative(found, -(b_in_a.rotation * of_a_in_b.by_translation), found.point_on_a, b_in_a);
  return found;
}

}  // namespace

SignedDistance detail::signedDistance(const Surface& a, const Surface& b, const Pose& b_in_a,
                                      const SignedDistanceOptions& options, const Clearance& clearance,
                                      DepthQuery& depth) {
  const double tolerance = depthTolerance(a, b, options);
  const Pose a_in_b = b_in_a.inverse();
  const auto depthIn = [&](const Surface& solid, const Surface& other, const Pose& other_in_solid) {
    const GougeDepth found = depth.deepest(solid, other, other_in_solid, tolerance);
    return solid.isClosed() || found.is_known ? found : GougeDepth();
  };
  const GougeDepth of_b = depthIn(a, b, b_in_a), of_a = depthIn(b, a, a_in_b);
  const bool b_goes_in = of_b.gouging == Gouging::found, a_goes_in = of_a.gouging == Gouging::found;
  if (!b_goes_in && !a_goes_in) return signedDistanceOf(clearance, b_in_a);
  if (b_goes_in && (!a_goes_in || of_b.depth >= of_a.depth)) {
    return signedDistanceOf(of_b, boundaryOf(a), boundaryOf(b), b_in_a, tolerance);
  }
  return exchanged(signedDistanceOf(of_a, boundaryOf(b), boundaryOf(a), a_in_b, tolerance), b_in_a);
}

SignedDistance signedDistance(const Surface& a, const Surface& b, const Pose& b_in_a,
                              const SignedDistanceOptions& options) {
  return PathQuery(a, b).signedDistance(b_in_a, options);
}

}  // namespace octoblisk
