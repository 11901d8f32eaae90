// A mesh as an external source of triangles.
#pragma once

#include "octoblisk/triangle_source.h"

namespace octoblisk::testing {

/// Hands out only the requested triangles, all of part 0.
class MeshSource final : public TriangleSource {
 public:
  explicit MeshSource(const TriangleMesh& mesh) : mesh_(mesh) {}

  Aabb bounds() const override { return mesh_.bounds(); }
  void forEachTriangleIn(const Aabb& box, FunctionRef<void(const SourceTriangle&)> visit) const override {
    ++queries;
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t) {
      if (!box.meets(boundsOf(mesh_.triangle(t)))) continue;
      visit({mesh_.triangle(t), 0, static_cast<int>(t)});
    }
  }

  mutable std::size_t queries = 0;  ///< number of queries

 private:
  const TriangleMesh& mesh_;
};

}  // namespace octoblisk::testing
