// Our shape against a convex one.
#pragma once

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include "contact/internal_edges.h"
#include "contact/solid.h"
#include "mesh_algorithm.h"
#include "octoblisk/hull_faces.h"
#include "octoblisk/triangle_cache.h"

namespace octoblisk::detail {

/// The core of a convex shape: its corners where it is the hull of a few points; the feet on which it may
/// stand.
class CoreCorners {
 public:
  /// As the shape is now; returns whether it has been scaled, or given points, since the last time. Allocates
  /// nothing where it has not.
  bool update(const btConvexShape& shape);

  std::span<const Vec3> points() const { return points_; }
  /// The mean of the points; without any, the shape's origin.
  const Vec3& middle() const { return middle_; }
  HullFaces faces() const { return faces_.view(); }
  /// The corners; points on the rims of cylinders and cones; none of other shapes.
  std::span<const Vec3> feet() const { return feet_; }

 private:
  std::vector<Vec3> points_, feet_, read_;
  Vec3 middle_ = Vec3::Zero();
  HullFaceList faces_;
};

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
