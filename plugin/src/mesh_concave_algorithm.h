// ClusteredOctreeShape against any other concave shape that provides triangles: Bullet's meshes, a
// heightfield, GImpact.
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include "contact/surface_contacts.h"
#include "mesh_algorithm.h"
#include "octoblisk/source_contacts.h"

namespace octoblisk::detail {

class MeshConcaveAlgorithm final : public MeshAlgorithm {
 public:
  MeshConcaveAlgorithm(const btCollisionAlgorithmConstructionInfo& info,
                       const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                       bool mesh_is_body1)
      : MeshAlgorithm(info, body0, body1, mesh_is_body1) {}

 private:
  void findContacts(const PosedShapes& shapes, double reach, std::vector<Contact>& found) override;
  void toSurfaceContacts(const PosedShapes& shapes, double reach, std::vector<Contact>& found) override;
  /// The shape does not report changes.
  bool readOther(const btCollisionShape&) override { return false; }
  double marginOfOther(const btCollisionShape& other) const override { return double(other.getMargin()); }
  std::optional<SourceTriangle> triangleOfOther(const btCollisionShape&,
                                                const Contact& contact) const override {
    return source_contacts_.triangle(contact.triangle_b);
  }

  SourceContacts source_contacts_;
  SurfaceContacts surface_contacts_;
};

}  // namespace octoblisk::detail
