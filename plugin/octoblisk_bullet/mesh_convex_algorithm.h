// Our shape against a convex one.
#pragma once

#include "octoblisk/internal_edges.h"
#include "octoblisk/near_triangles.h"
#include "octoblisk_bullet/mesh_algorithm.h"

namespace octoblisk {

class MeshConvexAlgorithm final : public MeshAlgorithm {
 public:
  MeshConvexAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* body0,
                      const btCollisionObjectWrapper* body1, bool mesh_is_body1)
      : MeshAlgorithm(info, body0, body1, mesh_is_body1) {}

 private:
  void findContacts(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other, double reach,
                    std::vector<Contact>& found) override;
  void trianglesHaveMoved() override { near_.forget(); }

  std::vector<Vec3> corners_;  // of the convex shape, as it is at this step
  NearTriangles near_;
  InternalEdges internal_edges_;
};

}  // namespace octoblisk
