// ClusteredOctreeShape against any other concave shape that provides triangles: Bullet's meshes, a
// heightfield, GImpact.
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include "contact/feature_contacts.h"
#include "contact/source_sheet.h"
#include "mesh_algorithm.h"
#include "octoblisk/source_contacts.h"

namespace octoblisk::detail {

class MeshConcaveAlgorithm final : public MeshAlgorithm {
 public:
  using MeshAlgorithm::MeshAlgorithm;

 private:
  void findTriangleContacts(const PosedShapes& shapes, std::vector<Contact>& found) override;
  void findBodyContacts(const PosedShapes& shapes, std::vector<Contact>& found) override;
  bool readOther(const PosedShapes& shapes) override;
  double marginOfOther(const btCollisionShape& other) const override { return double(other.getMargin()); }
  std::optional<SourceTriangle> triangleOfOther(const btCollisionShape&,
                                                const Contact& contact) const override {
    return sheet_.triangle(contact.triangle_b);
  }

  SourceContacts source_contacts_;
  SourceSheet sheet_;
  FeatureContacts feature_contacts_;
};

}  // namespace octoblisk::detail
