#include "mesh_plane_algorithm.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

#include "octoblisk/half_space_contacts.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk::detail {

void MeshPlaneAlgorithm::findContacts(const btCollisionObjectWrapper& mesh,
                                      const btCollisionObjectWrapper& other, double reach,
                                      std::vector<Contact>& found) {
  const auto& shape = static_cast<const ClusteredOctreeShape&>(*mesh.getCollisionShape());
  const auto& plane = static_cast<const btStaticPlaneShape&>(*other.getCollisionShape());
  const Pose plane_in_mesh =
      fromBullet(mesh.getWorldTransform()).inverse() * fromBullet(other.getWorldTransform());
  const Vec3 normal = fromBullet(plane.getPlaneNormal());
  HalfSpace half_space;
  half_space.normal = (plane_in_mesh.rotation * normal).normalized();
  half_space.offset = half_space.normal.dot(
      plane_in_mesh * (double(plane.getPlaneConstant()) / normal.squaredNorm() * normal));
  contacts(shape.tree(), half_space, reach, found);
}

bool MeshPlaneAlgorithm::readOther(const btCollisionObjectWrapper& other) {
  const auto& plane = static_cast<const btStaticPlaneShape&>(*other.getCollisionShape());
  const bool is_same = plane.getPlaneNormal() == normal_ && plane.getPlaneConstant() == constant_;
  normal_ = plane.getPlaneNormal();
  constant_ = plane.getPlaneConstant();
  return is_same;
}

}  // namespace octoblisk::detail
