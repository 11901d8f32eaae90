#include "mesh_mesh_algorithm.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contacts.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk::detail {

void MeshMeshAlgorithm::findContacts(const btCollisionObjectWrapper& mesh,
                                     const btCollisionObjectWrapper& other, double reach,
                                     std::vector<Contact>& found) {
  const auto& shape_a = static_cast<const ClusteredOctreeShape&>(*mesh.getCollisionShape());
  const auto& shape_b = static_cast<const ClusteredOctreeShape&>(*other.getCollisionShape());
  b_in_a_ = fromBullet(mesh.getWorldTransform()).inverse() * fromBullet(other.getWorldTransform());
  contacts(shape_a.tree(), shape_b.tree(), b_in_a_, reach, found);
}

void MeshMeshAlgorithm::toSurfaceContacts(const btCollisionObjectWrapper& mesh,
                                          const btCollisionObjectWrapper& other, double,
                                          std::vector<Contact>& found) {
  const auto& shape_a = static_cast<const ClusteredOctreeShape&>(*mesh.getCollisionShape());
  const auto& shape_b = static_cast<const ClusteredOctreeShape&>(*other.getCollisionShape());
  surface_contacts_.filter(
      found, [&](const Contact& contact) { return shape_a.tree().mesh().triangle(contact.triangle_a); },
      [&](const Contact& contact) { return b_in_a_ * shape_b.tree().mesh().triangle(contact.triangle_b); });
}

double MeshMeshAlgorithm::marginOfOther(const btCollisionObjectWrapper& other) const {
  return double(other.getCollisionShape()->getMargin());
}

std::optional<SourceTriangle> MeshMeshAlgorithm::triangleOfOther(const btCollisionObjectWrapper& other,
                                                                 const Contact& contact) const {
  return triangleOf(static_cast<const ClusteredOctreeShape&>(*other.getCollisionShape()), contact.triangle_b);
}

}  // namespace octoblisk::detail
