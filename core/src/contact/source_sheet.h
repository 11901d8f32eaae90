// The triangles of another library's surface near a body, as a mesh with features.
#pragma once

#include <memory>
#include <vector>

#include "contact/mesh_features.h"
#include "octoblisk/triangle_source.h"

namespace octoblisk::detail {

/// A TriangleSource says nothing about the inside, so its triangles are a sheet. What was made of them is
/// kept while the same triangles are read.
class SourceSheet {
 public:
  /// Reads the triangles of a source in a box of its frame, which is not empty, and some others. Triangles
  /// that are not finite are left out. Returns whether the triangles have changed. Allocates nothing while
  /// they stay the same.
  bool read(const TriangleSource& source, const Aabb& box);

  bool isEmpty() const { return !sheet_; }
  /// Unless empty: those of the sheet, in the source's frame.
  const MeshFeatures& features() const { return sheet_->features; }
  const SourceTriangle& triangle(std::uint32_t index) const { return triangles_[index]; }

 private:
  struct Sheet {
    explicit Sheet(const std::vector<SourceTriangle>& triangles);

    ClusteredOctree tree;
    MeshFeatures features;
  };

  std::vector<SourceTriangle> triangles_;     // of the sheet
  std::vector<SourceTriangle> read_, fresh_;  // the last ones and the new ones, in the source's order
  std::unique_ptr<const Sheet> sheet_;
};

}  // namespace octoblisk::detail
