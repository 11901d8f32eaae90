#include "mesh_mesh_algorithm.h"

#include <algorithm>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contacts.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "orthonormal_pose.h"

namespace octoblisk::detail {
namespace {

const ClusteredOctreeShape& ourShape(const btCollisionShape& shape) {
  return static_cast<const ClusteredOctreeShape&>(shape);
}

/// Converts a contact of B and A, in B's frame, to one of A and B in A's frame.
Contact exchanged(const Contact& of_b, const Pose& b_in_a) {
  return {b_in_a * of_b.point_on_b, b_in_a * of_b.point_on_a, -(b_in_a.rotation * of_b.normal), of_b.distance,
          of_b.triangle_b,          of_b.triangle_a};
}

}  // namespace

void MeshMeshAlgorithm::findTriangleContacts(const PosedShapes& shapes, std::vector<Contact>& found) {
  contacts(shapes.treeOfMesh(), shapes.treeOf(ourShape(shapes.other)), shapes.other_in_mesh, shapes.reach,
           found);
}

void MeshMeshAlgorithm::findBodyContacts(const PosedShapes& shapes, std::vector<Contact>& found) {
  const ClusteredOctreeShape &shape_a = shapes.mesh, &shape_b = ourShape(shapes.other);
  const Pose& b_in_a = shapes.other_in_mesh;
  feature_contacts_.find(shape_a.features(), shape_b.features(), orthonormal(b_in_a), shapes.other_when_apart,
                         shapes.reach, shapes.breaking, found);
  // Far vertices that are deeper than `reach` get contacts of their own.
  addWaysOut(shape_a, shape_b, b_in_a, shapes.reach, found);
}

void MeshMeshAlgorithm::addWaysOut(const ClusteredOctreeShape& shape_a, const ClusteredOctreeShape& shape_b,
                                   const Pose& b_in_a, double least_depth, std::vector<Contact>& found) {
  const SolidMesh solid_a = shape_a.solid(), solid_b = shape_b.solid();
  const ClusteredOctree &a = solid_a.boundary(), &b = solid_b.boundary();
  const bool is_b_smaller = b.mesh().bounds().halfExtents().norm() <= a.mesh().bounds().halfExtents().norm();
  if (!(is_b_smaller ? solid_a : solid_b).isAnywhereSolid()) return;
  const bool meet =
      std::ranges::any_of(found, [](const Contact& contact) { return contact.distance <= 0.0; });
  if (is_b_smaller) {
    far_vertices_.find(solid_a, b, shape_b.farVertices(), b_in_a, meet, least_depth, ways_out_);
  } else {
    far_vertices_.find(solid_b, a, shape_a.farVertices(), b_in_a.inverse(), meet, least_depth, ways_out_);
    for (Contact& contact : ways_out_) contact = exchanged(contact, b_in_a);
  }
  if (!meet && !ways_out_.empty()) found.clear();
  found.insert(found.end(), ways_out_.begin(), ways_out_.end());
}

std::optional<SourceTriangle> MeshMeshAlgorithm::triangleOfOther(const btCollisionShape& other,
                                                                 const Contact& contact) const {
  return triangleOf(ourShape(other), contact.triangle_b);
}

}  // namespace octoblisk::detail
