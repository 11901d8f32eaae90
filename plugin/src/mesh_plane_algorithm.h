// ClusteredOctreeShape against Bullet's plane, which is a half-space.
#pragma once

#include "mesh_algorithm.h"

namespace octoblisk::detail {

/// Ignores the plane's margin, as Bullet's convex-plane algorithm does.
class MeshPlaneAlgorithm final : public MeshAlgorithm {
 public:
  using MeshAlgorithm::MeshAlgorithm;

 private:
  void findTriangleContacts(const PosedShapes& shapes, std::vector<Contact>& found) override;
  bool readOther(const PosedShapes& shapes) override;

  btVector3 normal_ = btVector3(0, 0, 0);
  btScalar constant_ = 0;
};

}  // namespace octoblisk::detail
