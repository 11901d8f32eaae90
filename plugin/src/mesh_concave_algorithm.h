// ClusteredOctreeShape against any other concave shape that provides triangles: Bullet's meshes, a
// heightfield, GImpact.
#pragma once

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
  void findContacts(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other, double reach,
                    std::vector<Contact>& found) override;
  bool readOther(const btCollisionObjectWrapper&) override {
    return false;
  }  // the shape does not report changes
  void toSurfaceContacts(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other,
                         double reach, std::vector<Contact>& found) override;
  double marginOfOther(const btCollisionObjectWrapper& other) const override;
  std::optional<SourceTriangle> triangleOfOther(const btCollisionObjectWrapper& other,
                                                const Contact& contact) const override;

  SourceContacts source_contacts_;
  Pose other_in_mesh_;
  SurfaceContacts surface_contacts_;
};

}  // namespace octoblisk::detail
