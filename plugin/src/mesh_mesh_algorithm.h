// ClusteredOctreeShape against ClusteredOctreeShape: two concave bodies that may both move.
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include "contact/far_vertices.h"
#include "contact/feature_contacts.h"
#include "mesh_algorithm.h"

namespace octoblisk::detail {

class MeshMeshAlgorithm final : public MeshAlgorithm {
 public:
  using MeshAlgorithm::MeshAlgorithm;

 private:
  void findTriangleContacts(const PosedShapes& shapes, std::vector<Contact>& found) override;
  void findBodyContacts(const PosedShapes& shapes, std::vector<Contact>& found) override;
  bool readOther(const PosedShapes&) override { return true; }
  double marginOfOther(const btCollisionShape& other) const override { return double(other.getMargin()); }
  std::optional<SourceTriangle> triangleOfOther(const btCollisionShape& other,
                                                const Contact& contact) const override;
  void trianglesHaveMoved() override { far_vertices_.forget(); }

  void addWaysOut(const ClusteredOctreeShape& shape_a, const ClusteredOctreeShape& shape_b,
                  const Pose& b_in_a, double least_depth, std::vector<Contact>& found);

  FarVerticesInSolid far_vertices_;  // of the smaller mesh in the other
  std::vector<Contact> ways_out_;
  FeatureContacts feature_contacts_;
};

}  // namespace octoblisk::detail
