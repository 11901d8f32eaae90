// Our shape against a convex shape.
#pragma once

#include "bullet_convex.h"
#include "contact/internal_edges.h"
#include "contact/point_in_solid.h"
#include "mesh_algorithm.h"
#include "octoblisk/triangle_cache.h"

namespace octoblisk::detail {

class MeshConvexAlgorithm final : public MeshAlgorithm {
 public:
  using MeshAlgorithm::MeshAlgorithm;

 private:
  void findTriangleContacts(const PosedShapes& shapes, std::vector<Contact>& found) override;
  void findBodyContacts(const PosedShapes& shapes, std::vector<Contact>& found) override;
  bool readOther(const PosedShapes& shapes) override;
  std::optional<WayBack::ConvexBody> convexOther() override {
    return WayBack::ConvexBody{core_.middle(), feet_, double(margin_)};
  }
  void trianglesHaveMoved() override {
    near_.forget();
    middle_.forget();
  }

  ConvexCore core_;
  struct FeetOfCore {
    ConvexCore& core;
    std::span<const Vec3> operator()(const Vec3& towards) const { return core.feet(towards); }
  } feet_{core_};
  Aabb bounds_;          // of the convex shape
  btScalar margin_ = 0;  // of the convex shape
  TriangleCache near_;
  InternalEdges internal_edges_;
  PointInSolid middle_;  // of the convex shape
};

}  // namespace octoblisk::detail
