#include "query/depth_bounds.h"

#include <algorithm>
#include <limits>

#include "geometry/polygon.h"
#include "geometry/thin_triangle.h"

namespace octoblisk::detail {

void appendCut(const Triangle& of, const Triangle& by, std::vector<Vec3>& corners) {
  const Vec3 scaled = scaledNormal(by);
  const double length = scaled.norm();
  double size = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    size = std::max({size, of[i].cwiseAbs().maxCoeff(), by[i].cwiseAbs().maxCoeff()});
  }
  Polygon<8> rest(of);
  const auto cut = [&](const Vec3& inward, const Vec3& on_plane) {
    rest.cut([&](const Vec3& point) { return inward.dot(point - on_plane); });
  };
  // The thinner the triangle, the greater the rounding error of its normal.
  const double squared_edge = squaredLongestEdge(by);
  if (length > 1e-12 * squared_edge) {  // otherwise keep all
    const double slack = 1e-14 * size * (1.0 + squared_edge / length);
    const Vec3 normal = scaled / length;
    cut(normal, by[0] - slack * normal);
    cut(-normal, by[0] + slack * normal);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 inward = normal.cross(by[(i + 1) % 3] - by[i]).normalized();
      cut(inward, by[i] - slack * inward);
    }
  }
  corners.insert(corners.end(), rest.corners().begin(), rest.corners().end());
}

double leastMean(std::span<const double> first, std::span<const double> second) {
  // Each column is a line over the weight of the second row. The result is the lowest point of their upper
  // hull.
  const auto highestAt = [&](double weight) {
    std::size_t highest = 0;
    double height = -1.0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      const double here = first[i] + weight * (second[i] - first[i]);
      if (here > height) {
        height = here;
        highest = i;
      }
    }
    return std::pair(highest, height);
  };
  if (first.empty()) return 0.0;
  auto [falling, height_at_0] = highestAt(0.0);
  auto [rising, height_at_1] = highestAt(1.0);
  double least = std::min(height_at_0, height_at_1);
  for (int step = 0; step < 5; ++step) {
    const double slope_falling = second[falling] - first[falling],
                 slope_rising = second[rising] - first[rising];
    if (!(slope_falling < 0.0 && slope_rising > 0.0)) break;
    const double weight = (first[falling] - first[rising]) / (slope_rising - slope_falling);
    if (!(weight > 0.0 && weight < 1.0)) break;
    const auto [highest, height] = highestAt(weight);
    least = std::min(least, height);
    if (highest == falling || highest == rising) break;
    (second[highest] < first[highest] ? falling : rising) = highest;
  }
  return least;
}

double levelMean(std::span<const double> a, std::span<const double> b, std::span<const double> c) {
  const double none = std::numeric_limits<double>::infinity();
  const Vec3 first(a[1] - a[0], b[1] - b[0], c[1] - c[0]), second(a[2] - a[0], b[2] - b[0], c[2] - c[0]);
  Vec3 weights = first.cross(second);
  const double sum = weights.sum();
  if (sum == 0.0) return none;
  weights /= sum;
  if (!(weights.minCoeff() >= 0.0)) return none;
  double greatest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) greatest = std::max(greatest, weights.dot(Vec3(a[i], b[i], c[i])));
  return greatest;
}

}  // namespace octoblisk::detail
