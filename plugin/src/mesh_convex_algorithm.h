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
  void findContacts(const PosedShapes& shapes, double reach, std::vector<Contact>& found) override;
  void toSurfaceContacts(const PosedShapes& shapes, double reach, std::vector<Contact>& found) override;
  bool readOther(const btCollisionShape& other) override;
  void trianglesHaveMoved() override {
    near_.forget();
    middle_.forget();
  }

  CoreCorners core_;
  Aabb bounds_;          // of the convex shape
  btScalar margin_ = 0;  // of the convex shape
  TriangleCache near_;
  InternalEdges internal_edges_;
  PointInSolid middle_;  // of the convex shape
};

}  // namespace octoblisk::detail
