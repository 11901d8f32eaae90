#include "tree/tree_vertices.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/tree_vertices.cpp"
#include <hwy/foreach_target.h>

#include "simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// The bounds of at least eight points.
Extent extentOf(const float* const* coordinates, std::size_t count, const Eigen::Matrix3f& axes,
                const Eigen::Vector3f& from) {
  const Vec8 origin = Vec8::all(from);
  Vec8 axis[3];
  for (int k = 0; k < 3; ++k) axis[k] = Vec8::all(axes.col(k));
  const Float8 infinity(std::numeric_limits<float>::infinity());
  Float8 low[3] = {infinity, infinity, infinity};
  Float8 high[3];
  for (Float8& all : high) all = Float8(0.0f) - infinity;
  const auto extend = [&](std::size_t i) HWY_ATTR {
    const Vec8 offset = Vec8{Float8::load(coordinates[0] + i), Float8::load(coordinates[1] + i),
                             Float8::load(coordinates[2] + i)} -
                        origin;
    for (int k = 0; k < 3; ++k) {
      const Float8 along = dot(axis[k], offset);
      low[k] = min(low[k], along);
      high[k] = max(high[k], along);
    }
  };
  for (std::size_t i = 0; i + kLanes <= count; i += kLanes) extend(i);
  extend(count - kLanes);  // the rest, and some points twice

  Extent extent;
  for (int k = 0; k < 3; ++k) {
    float lows[kLanes], highs[kLanes];
    low[k].store(lows);
    high[k].store(highs);
    for (int lane = 0; lane < kLanes; ++lane) {
      extent.low[k] = std::min(extent.low[k], lows[lane]);
      extent.high[k] = std::max(extent.high[k], highs[lane]);
    }
  }
  return extent;
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/parallel.h"

namespace octoblisk::detail {

HWY_EXPORT(extentOf);

TreeVertices::TreeVertices(const TriangleMesh& mesh, std::span<const std::uint32_t> order, const Vec3& origin,
                           int threads)
    : count_(3 * order.size()), coordinates_(std::make_unique_for_overwrite<float[]>(3 * count_)) {
  constexpr std::size_t kChunk = 8192;
  parallelForChunks(order.size(), kChunk, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const TriangleMesh::Indices& corners = mesh.triangles()[order[i]];
      for (std::size_t v = 0; v < 3; ++v) {
        const Eigen::Vector3f corner = (mesh.vertices()[corners[v]] - origin).cast<float>();
        for (std::size_t k = 0; k < 3; ++k)
          coordinates_[k * count_ + 3 * i + v] = corner[static_cast<Eigen::Index>(k)];
      }
    }
  });
}

Eigen::Vector3f TreeVertices::first(std::uint32_t triangle) const {
  const float* x = coordinates_.get() + 3 * std::size_t{triangle};
  return {x[0], x[count_], x[2 * count_]};
}

Extent TreeVertices::extent(TriangleRange range, const Eigen::Matrix3f& axes,
                            const Eigen::Vector3f& from) const {
  const float* x = coordinates_.get() + 3 * std::size_t{range.begin};
  const float* const rows[3] = {x, x + count_, x + 2 * count_};
  const std::size_t count = 3 * std::size_t{range.count()};
  if (count >= kLanes) return HWY_DYNAMIC_DISPATCH(extentOf)(rows, count, axes, from);
  Extent extent;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f offset = Eigen::Vector3f(rows[0][i], rows[1][i], rows[2][i]) - from;
    for (int k = 0; k < 3; ++k) {
      const float along = axes(0, k) * offset[0] + axes(1, k) * offset[1] + axes(2, k) * offset[2];
      extent.low[k] = std::min(extent.low[k], along);
      extent.high[k] = std::max(extent.high[k], along);
    }
  }
  return extent;
}

}  // namespace octoblisk::detail
#endif
