#include "grinding/support_planes.h"

#include <algorithm>

#include "base/parallel.h"
#include "query/farthest_vertex.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr std::size_t kCells = 32;  // along each edge of a side of the cube

}  // namespace

SupportPlanes::SupportPlanes(const ClusteredOctree& tree, int threads) : planes_(6 * kCells * kCells) {
  parallelFor(planes_.size(), threads, [&](std::size_t plane, std::size_t) {
    const std::size_t side = plane / (kCells * kCells), row = plane / kCells % kCells,
                      column = plane % kCells;
    const auto middle = [](std::size_t cell) {
      return (2.0 * static_cast<double>(cell) + 1.0) / kCells - 1.0;
    };
    const auto axis = static_cast<Eigen::Index>(side / 2);
    Vec3 direction;
    direction[axis] = side % 2 == 0 ? 1.0 : -1.0;
    direction[(axis + 1) % 3] = middle(row);
    direction[(axis + 2) % 3] = middle(column);
    const Vec3 normal = direction.normalized();
    planes_[plane] = {normal, normal.dot(farthestVertex(tree, normal))};
  });
}

std::size_t SupportPlanes::facing(const Vec3& direction) const {
  Eigen::Index axis;
  const double largest = direction.cwiseAbs().maxCoeff(&axis);
  const auto cellOf = [&](Eigen::Index other) {
    const double at = 0.5 * (direction[other % 3] / largest + 1.0) * kCells;
    return std::min(static_cast<std::size_t>(at), kCells - 1);
  };
  const std::size_t side = 2 * static_cast<std::size_t>(axis) + (direction[axis] < 0.0);
  return (side * kCells + cellOf(axis + 1)) * kCells + cellOf(axis + 2);
}

}  // namespace octoblisk::demos
