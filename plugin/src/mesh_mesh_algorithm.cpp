#include "mesh_mesh_algorithm.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

#include <algorithm>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contacts.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk::detail {
namespace {

/// Converts a contact of B and A, in B's frame, to one of A and B in A's frame.
Contact turnedRound(const Contact& of_b, const Pose& b_in_a) {
  return {b_in_a * of_b.point_on_b, b_in_a * of_b.point_on_a, -(b_in_a.rotation * of_b.normal), of_b.distance,
          of_b.triangle_b,          of_b.triangle_a};
}

}  // namespace

void MeshMeshAlgorithm::findContacts(const btCollisionObjectWrapper& mesh,
                                     const btCollisionObjectWrapper& other, double reach,
                                     std::vector<Contact>& found) {
  const auto& shape_a = static_cast<const ClusteredOctreeShape&>(*mesh.getCollisionShape());
  const auto& shape_b = static_cast<const ClusteredOctreeShape&>(*other.getCollisionShape());
  b_in_a_ = fromBullet(mesh.getWorldTransform()).inverse() * fromBullet(other.getWorldTransform());
  contacts(shape_a.tree(), shape_b.tree(), b_in_a_, reach, found);
}

void MeshMeshAlgorithm::toSurfaceContacts(const btCollisionObjectWrapper& mesh,
                                          const btCollisionObjectWrapper& other, double reach,
                                          std::vector<Contact>& found) {
  const auto& shape_a = static_cast<const ClusteredOctreeShape&>(*mesh.getCollisionShape());
  const auto& shape_b = static_cast<const ClusteredOctreeShape&>(*other.getCollisionShape());
  surface_contacts_.filter(
      found, [&](const Contact& contact) { return shape_a.tree().mesh().triangle(contact.triangle_a); },
      [&](const Contact& contact) { return b_in_a_ * shape_b.tree().mesh().triangle(contact.triangle_b); });
  addWaysOut(shape_a, shape_b, reach, found);
}

void MeshMeshAlgorithm::addWaysOut(const ClusteredOctreeShape& shape_a, const ClusteredOctreeShape& shape_b,
                                   double least_depth, std::vector<Contact>& found) {
  const ClusteredOctree &a = shape_a.tree(), &b = shape_b.tree();
  const bool is_b_smaller = b.mesh().bounds().halfExtents().norm() <= a.mesh().bounds().halfExtents().norm();
  if (!(is_b_smaller ? shape_a : shape_b).isSolid()) return;
  const bool meet =
      std::ranges::any_of(found, [](const Contact& contact) { return contact.distance <= 0.0; });
  if (is_b_smaller) {
    far_vertices_.find(a, b, shape_b.farVertices(), b_in_a_, meet, least_depth, ways_out_);
  } else {
    far_vertices_.find(b, a, shape_a.farVertices(), b_in_a_.inverse(), meet, least_depth, ways_out_);
    for (Contact& contact : ways_out_) contact = turnedRound(contact, b_in_a_);
  }
  if (!meet && !ways_out_.empty()) found.clear();
  found.insert(found.end(), ways_out_.begin(), ways_out_.end());
}

const ClusteredOctreeShape* MeshMeshAlgorithm::meshOfOther(const btCollisionObjectWrapper& other) const {
  return static_cast<const ClusteredOctreeShape*>(other.getCollisionShape());
}

double MeshMeshAlgorithm::marginOfOther(const btCollisionObjectWrapper& other) const {
  return double(other.getCollisionShape()->getMargin());
}

std::optional<SourceTriangle> MeshMeshAlgorithm::triangleOfOther(const btCollisionObjectWrapper& other,
                                                                 const Contact& contact) const {
  return triangleOf(static_cast<const ClusteredOctreeShape&>(*other.getCollisionShape()), contact.triangle_b);
}

}  // namespace octoblisk::detail
