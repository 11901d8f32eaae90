#include "mesh_plane_algorithm.h"

#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

#include "octoblisk/half_space_contacts.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk::detail {

void MeshPlaneAlgorithm::findTriangleContacts(const PosedShapes& shapes, std::vector<Contact>& found) {
  const auto& plane = static_cast<const btStaticPlaneShape&>(shapes.other);
  const Pose& plane_in_mesh = shapes.other_in_mesh;
  const Vec3 normal = fromBullet(plane.getPlaneNormal());
  HalfSpace half_space;
  half_space.normal = (plane_in_mesh.rotation * normal).normalized();
  half_space.offset = half_space.normal.dot(
      plane_in_mesh * (double(plane.getPlaneConstant()) / normal.squaredNorm() * normal));
  contacts(shapes.treeOfMesh(), half_space, shapes.reach, found);
}

bool MeshPlaneAlgorithm::readOther(const PosedShapes& shapes) {
  const auto& plane = static_cast<const btStaticPlaneShape&>(shapes.other);
  const bool is_same = plane.getPlaneNormal() == normal_ && plane.getPlaneConstant() == constant_;
  normal_ = plane.getPlaneNormal();
  constant_ = plane.getPlaneConstant();
  return is_same;
}

}  // namespace octoblisk::detail
