// Our shape against our shape: moving concave against concave.
#pragma once

#include "contact/surface_contacts.h"
#include "mesh_algorithm.h"

namespace octoblisk::detail {

class MeshMeshAlgorithm final : public MeshAlgorithm {
 public:
  MeshMeshAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* body0,
                    const btCollisionObjectWrapper* body1)
      : MeshAlgorithm(info, body0, body1, false) {}

 private:
  void findContacts(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other, double reach,
                    std::vector<Contact>& found) override;
  void toSurfaceContacts(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other,
                         double reach, std::vector<Contact>& found) override;
  double marginOfOther(const btCollisionObjectWrapper& other) const override;
  std::optional<SourceTriangle> triangleOfOther(const btCollisionObjectWrapper& other,
                                                const Contact& contact) const override;

  Pose b_in_a_;
  SurfaceContacts surface_contacts_;
};

}  // namespace octoblisk::detail
