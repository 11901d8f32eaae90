// A closed mesh with its tree and surface.
#pragma once

#include <utility>

#include "octoblisk/surface.h"
#include "shared/meshes.h"

namespace octoblisk {

struct Solid {
  explicit Solid(testing::SharedMesh shared, PartitionKind kind = PartitionKind::clustering)
      : mesh(std::move(shared)), tree(ClusteredOctree::build(mesh, {.partition = kind})), surface(tree) {}
  Solid(const Solid&) = delete;

  testing::SharedMesh mesh;
  ClusteredOctree tree;
  Surface surface;
};

}  // namespace octoblisk
