// A triangle during the build of a tree: single precision, relative to the tree's origin.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

struct alignas(64) TriangleRecord {
  std::array<Eigen::Vector3f, 3> vertices;
  Eigen::Vector3f centroid;
  Eigen::Vector3f normal;  ///< unit; zero for a degenerate triangle
  std::uint32_t triangle;  ///< index in the mesh
};

/// Records that are initially uninitialised, because they are written later anyway.
class TriangleRecords {
 public:
  TriangleRecords() = default;
  explicit TriangleRecords(std::size_t count)
      : records_(std::make_unique_for_overwrite<TriangleRecord[]>(count)), count_(count) {}

  std::size_t size() const { return count_; }
  std::span<TriangleRecord> span() { return {records_.get(), count_}; }

 private:
  std::unique_ptr<TriangleRecord[]> records_;
  std::size_t count_ = 0;
};

/// The records of all triangles, in the mesh's order.
TriangleRecords makeRecords(const TriangleMesh& mesh, const Vec3& origin, int threads);

}  // namespace octoblisk::detail
