#include "geometry/gjk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace octoblisk::detail {
namespace {

constexpr int kMaxIterations = 64;

/// A point of a simplex as weights of its corners. Only corners of positive weight are kept.
struct Closest {
  Vec3 point = Vec3::Zero();
  std::array<std::size_t, 4> corner{};
  std::array<double, 4> weight{};
  std::size_t count = 0;

  void add(std::size_t index, double w, const Simplex& simplex) {
    if (!(w > 0.0)) return;
    corner[count] = index;
    weight[count++] = w;
    point += w * simplex.point[index].difference;
  }
};

Vec3 corner(const Simplex& simplex, std::size_t index) { return simplex.point[index].difference; }

Closest closestOnSegment(const Simplex& simplex, std::size_t i, std::size_t j) {
  const Vec3 a = corner(simplex, i), edge = corner(simplex, j) - a;
  const double squared = edge.squaredNorm();
  const double t = squared > 0.0 ? std::clamp(-a.dot(edge) / squared, 0.0, 1.0) : 0.0;
  Closest closest;
  closest.add(i, 1.0 - t, simplex);
  closest.add(j, t, simplex);
  return closest;
}

Closest nearer(const Closest& a, const Closest& b) {
  return a.point.squaredNorm() <= b.point.squaredNorm() ? a : b;
}

Closest closestOnTriangle(const Simplex& simplex, std::size_t i, std::size_t j, std::size_t k) {
  const Vec3 a = corner(simplex, i), b = corner(simplex, j), c = corner(simplex, k);
  const Vec3 normal = (b - a).cross(c - a);
  const double squared = normal.squaredNorm();
  const double wa = b.cross(c).dot(normal), wb = c.cross(a).dot(normal), wc = a.cross(b).dot(normal);
  if (squared > 0.0 && wa >= 0.0 && wb >= 0.0 && wc >= 0.0) {
    const double sum = wa + wb + wc;
    Closest closest;
    closest.add(i, wa / sum, simplex);
    closest.add(j, wb / sum, simplex);
    closest.add(k, wc / sum, simplex);
    closest.point = normal * (a.dot(normal) / squared);  // without the weights' rounding
    return closest;
  }
  return nearer(nearer(closestOnSegment(simplex, i, j), closestOnSegment(simplex, j, k)),
                closestOnSegment(simplex, k, i));
}

/// The point of a tetrahedron closest to the origin; all four corners if the origin is inside.
Closest closestOnTetrahedron(const Simplex& simplex) {
  constexpr std::array<std::array<std::size_t, 4>, 4> kFaces = {
      {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}}};
  Closest best;
  best.point.setConstant(std::numeric_limits<double>::infinity());
  bool inside = true;
  for (const auto& [i, j, k, opposite] : kFaces) {
    const Vec3 a = corner(simplex, i);
    const Vec3 normal = (corner(simplex, j) - a).cross(corner(simplex, k) - a);
    const double height = normal.dot(corner(simplex, opposite) - a), origin_height = -normal.dot(a);
    if (height * origin_height > 0.0) continue;  // the origin is on the inner side of this face
    inside = false;
    best = nearer(best, closestOnTriangle(simplex, i, j, k));
  }
  if (!inside) return best;
  Closest whole;
  whole.count = 4;
  return whole;
}

Closest closestOnSimplex(const Simplex& simplex) {
  switch (simplex.count) {
    case 1: {
      Closest closest;
      closest.add(0, 1.0, simplex);
      return closest;
    }
    case 2:
      return closestOnSegment(simplex, 0, 1);
    case 3:
      return closestOnTriangle(simplex, 0, 1, 2);
    default:
      return closestOnTetrahedron(simplex);
  }
}

void keepOnly(Simplex& simplex, const Closest& closest) {
  std::array<SupportPoint, 3> kept;
  for (std::size_t c = 0; c < closest.count; ++c) kept[c] = simplex.point[closest.corner[c]];
  std::copy_n(kept.begin(), closest.count, simplex.point.begin());
  simplex.count = closest.count;
}

}  // namespace

SupportPoint supportOfDifference(const Triangle& triangle, const Convex& convex, const Vec3& direction) {
  const Vec3 on_triangle =
      *std::ranges::max_element(triangle, {}, [&](const Vec3& v) { return v.dot(direction); });
  const Vec3 on_core = convex.support(-direction);
  return {on_triangle - on_core, on_triangle, on_core};
}

GjkResult gjk(const Triangle& triangle, const Convex& convex, double limit) {
  GjkResult result;
  Simplex& simplex = result.simplex;
  // The vector from the middle of the triangle to that of the core is a good first guess, unless it is 0.
  const Vec3 way = convex.middle() - centroidOf(triangle);
  simplex.point[0] = supportOfDifference(triangle, convex, way.squaredNorm() > 0.0 ? way : Vec3::UnitX());
  simplex.count = 1;
  Closest closest = closestOnSimplex(simplex);
  // Only the core's support points are inexact, so the triangle's size must not widen the tolerance.
  double core_size = simplex.point[0].on_core.norm();
  double largest = closest.point.squaredNorm();  // of the difference; determines the scale of rounding
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const double squared = closest.point.squaredNorm();
    const double rounding = convex.precision() * core_size + 1e-14 * std::sqrt(largest);
    if (squared <= rounding * rounding) {
      result.overlap = true;
      break;
    }
    const SupportPoint next = supportOfDifference(triangle, convex, -closest.point);
    largest = std::max(largest, next.difference.squaredNorm());
    core_size = std::max(core_size, next.on_core.norm());
    const double bound = closest.point.dot(next.difference);  // squared · (proved lower bound / distance)
    if (bound > 0.0 && bound * bound > limit * limit * squared) {
      result.beyond_limit = true;
      return result;
    }
    if (squared - bound <= rounding * std::sqrt(squared)) break;
    simplex.point[simplex.count++] = next;
    const Closest step = closestOnSimplex(simplex);
    if (step.count == 4) {
      result.overlap = true;
      break;
    }
    if (step.point.squaredNorm() >= squared) {  // no more progress, due to rounding
      --simplex.count;
      break;
    }
    keepOnly(simplex, step);
    closest = step;
    for (std::size_t c = 0; c < closest.count; ++c) closest.corner[c] = c;
  }
  for (std::size_t c = 0; c < closest.count; ++c) {
    const SupportPoint& point = simplex.point[c];
    result.on_triangle += closest.weight[c] * point.on_triangle;
    result.on_core += closest.weight[c] * point.on_core;
  }
  return result;
}

}  // namespace octoblisk::detail
