#include "shared/brute_force.h"

#include <algorithm>
#include <limits>

#include "geometry/triangle_pair.h"

namespace octoblisk::testing {

using namespace detail;

namespace {

using IntVec = Eigen::Matrix<std::int64_t, 3, 1>;

template <typename Visit>
void forEachPairNear(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a, double reach,
                     Visit&& visit) {
  std::vector<Triangle> posed;
  std::vector<Aabb> bounds;
  for (std::size_t j = 0; j < b.triangleCount(); ++j) {
    posed.push_back(b_in_a * b.triangle(j));
    bounds.push_back(boundsOf(posed.back()));
  }
  for (std::size_t i = 0; i < a.triangleCount(); ++i) {
    const Triangle triangle = a.triangle(i);
    const Aabb box = boundsOf(triangle).grown(1.001 * reach);
    for (std::size_t j = 0; j < posed.size(); ++j) {
      if (!box.meets(bounds[j])) continue;
      visit(TrianglePair{static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)}, triangle, posed[j]);
    }
  }
}

bool separated(const IntVec& axis, const std::array<IntVec, 3>& a, const std::array<IntVec, 3>& b) {
  const auto along = [&](const IntVec& point) { return axis.dot(point); };
  const auto [low_a, high_a] = std::minmax({along(a[0]), along(a[1]), along(a[2])});
  const auto [low_b, high_b] = std::minmax({along(b[0]), along(b[1]), along(b[2])});
  return high_a < low_b || high_b < low_a;
}

}  // namespace

std::vector<TrianglePair> bruteForcePairs(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a) {
  std::vector<TrianglePair> pairs;
  forEachPairNear(a, b, b_in_a, 0.0, [&](TrianglePair pair, const Triangle& in_a, const Triangle& in_b) {
    if (intersects(in_a, in_b)) pairs.push_back(pair);
  });
  return pairs;
}

double bruteForceDistance(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < b.triangleCount(); ++j) {
    const Triangle posed = b_in_a * b.triangle(j);
    for (std::size_t i = 0; i < a.triangleCount(); ++i)
      least = std::min(least, closestPoints(a.triangle(i), posed).distance);
  }
  return least;
}

std::vector<Contact> bruteForceContacts(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a,
                                        double threshold) {
  std::vector<Contact> found;
  forEachPairNear(a, b, b_in_a, threshold,
                  [&](TrianglePair pair, const Triangle& in_a, const Triangle& in_b) {
                    Contact contact = contactOf(in_a, in_b);
                    if (contact.distance > threshold) return;
                    contact.triangle_a = pair.a;
                    contact.triangle_b = pair.b;
                    found.push_back(contact);
                  });
  return found;
}

double deepest(const std::vector<Contact>& contacts) {
  return std::ranges::min_element(contacts, {}, &Contact::distance)->distance;
}

bool integerTrianglesMeet(const Triangle& triangle_a, const Triangle& triangle_b) {
  std::array<IntVec, 3> a, b;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = triangle_a[i].cast<std::int64_t>();
    b[i] = triangle_b[i].cast<std::int64_t>();
  }
  // Facet normals of the Minkowski difference, whatever its dimension: 3-D, flat, a segment, a point.
  std::vector<IntVec> edges, axes;
  for (std::size_t i = 0; i < 3; ++i) {
    edges.push_back(a[(i + 1) % 3] - a[i]);
    edges.push_back(b[(i + 1) % 3] - b[i]);
  }
  const IntVec offset = a[0] - b[0];
  axes.push_back(offset);
  for (const IntVec& e : edges) {
    axes.push_back(e);
    axes.push_back(offset.cross(e).cross(e));
    for (const IntVec& f : edges) {
      const IntVec normal = e.cross(f);
      axes.push_back(normal);
      for (const IntVec& g : edges) axes.push_back(normal.cross(g));
    }
  }
  return std::ranges::none_of(axes, [&](const IntVec& axis) { return separated(axis, a, b); });
}

double boxTriangleOverlap(const Obb& box, const Triangle& triangle) {
  std::array<Vec3, 3> local;
  for (std::size_t i = 0; i < 3; ++i) local[i] = box.axes.transpose() * (triangle[i] - box.center);
  std::vector<Vec3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), scaledNormal(local)};
  for (std::size_t i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) axes.push_back(Vec3::Unit(k).cross(local[(i + 1) % 3] - local[i]));
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& axis : axes) {
    if (axis.norm() < 1e-12) continue;
    const Vec3 unit = axis.normalized();
    const auto [low, high] = std::minmax({unit.dot(local[0]), unit.dot(local[1]), unit.dot(local[2])});
    const double radius = unit.cwiseAbs().dot(box.half_extents);
    least = std::min({least, radius - low, radius + high});
  }
  return least;
}

}  // namespace octoblisk::testing
