// Our shape against a convex shape.
#pragma once

#include "bullet_convex.h"
#include "contact/internal_edges.h"
#include "contact/solid.h"
#include "mesh_algorithm.h"
#include "octoblisk/triangle_cache.h"

namespace octoblisk::detail {

class MeshConvexAlgorithm final : public MeshAlgorithm {
 public:
  MeshConvexAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* body0,
                      const btCollisionObjectWrapper* body1, bool mesh_is_body1)
      : MeshAlgorithm(info, body0, body1, mesh_is_body1) {}

 private:
  void findContacts(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other, double reach,
                    std::vector<Contact>& found) override;
  bool readOther(const btCollisionObjectWrapper& other) override;
  void toSurfaceContacts(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other,
                         double reach, std::vector<Contact>& found) override;
  void trianglesHaveMoved() override {
    near_.forget();
    middle_.forget();
  }

  CoreCorners core_;
  btVector3 min_ = btVector3(0, 0, 0), max_ = btVector3(0, 0, 0);  // of the convex shape's bounds
  btScalar margin_ = 0;                                            // of the convex shape
  TriangleCache near_;
  Pose convex_in_mesh_;
  InternalEdges internal_edges_;
  PointInSolid middle_;  // of the convex shape
};

}  // namespace octoblisk::detail
