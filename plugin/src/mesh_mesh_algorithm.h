// ClusteredOctreeShape against ClusteredOctreeShape: two concave bodies that may both move.
#pragma once

#include "contact/solid.h"
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
  bool readOther(const btCollisionObjectWrapper&) override { return true; }
  void toSurfaceContacts(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other,
                         double reach, std::vector<Contact>& found) override;
  const ClusteredOctreeShape* meshOfOther(const btCollisionObjectWrapper& other) const override;
  double marginOfOther(const btCollisionObjectWrapper& other) const override;
  std::optional<SourceTriangle> triangleOfOther(const btCollisionObjectWrapper& other,
                                                const Contact& contact) const override;

  void trianglesHaveMoved() override { far_vertices_.forget(); }

  void addWaysOut(const ClusteredOctreeShape& shape_a, const ClusteredOctreeShape& shape_b,
                  double least_depth, std::vector<Contact>& found);

  Pose b_in_a_;
  FarVerticesInSolid far_vertices_;  // of the smaller mesh in the other
  std::vector<Contact> ways_out_;
  SurfaceContacts surface_contacts_;
};

}  // namespace octoblisk::detail
