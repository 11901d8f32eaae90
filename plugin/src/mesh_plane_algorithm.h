// ClusteredOctreeShape against Bullet's plane, which is a half-space.
#pragma once

#include "mesh_algorithm.h"

namespace octoblisk::detail {

/// Ignores the plane's margin, as Bullet's convex-plane algorithm does.
class MeshPlaneAlgorithm final : public MeshAlgorithm {
 public:
  MeshPlaneAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* body0,
                     const btCollisionObjectWrapper* body1, bool mesh_is_body1)
      : MeshAlgorithm(info, body0, body1, mesh_is_body1) {}

 private:
  void findContacts(const PosedShapes& shapes, double reach, std::vector<Contact>& found) override;
  bool readOther(const btCollisionShape& other) override;

  btVector3 normal_ = btVector3(0, 0, 0);
  btScalar constant_ = 0;
};

}  // namespace octoblisk::detail
