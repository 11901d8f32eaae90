#include "mesh_convex_algorithm.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

#include "contact/corner_contacts.h"
#include "contact/flat_contacts.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/contacts.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk::detail {

bool MeshConvexAlgorithm::readOther(const btCollisionObjectWrapper& other) {
  const auto& shape = static_cast<const btConvexShape&>(*other.getCollisionShape());
  const bool has_other_corners = core_.update(shape);
  btVector3 min, max;
  shape.getAabb(btTransform::getIdentity(), min, max);
  const btScalar margin = shape.getMarginNonVirtual();
  const bool has_other_bounds = min != min_ || max != max_ || margin != margin_;
  min_ = min;
  max_ = max;
  margin_ = margin;
  const bool is_known = !core_.points().empty() || shape.getShapeType() == CYLINDER_SHAPE_PROXYTYPE ||
                        shape.getShapeType() == CONE_SHAPE_PROXYTYPE;
  return is_known && !has_other_corners && !has_other_bounds;
}

void MeshConvexAlgorithm::findContacts(const btCollisionObjectWrapper& mesh,
                                       const btCollisionObjectWrapper& other, double reach,
                                       std::vector<Contact>& found) {
  const auto& shape = static_cast<const ClusteredOctreeShape&>(*mesh.getCollisionShape());
  const auto& convex_shape = static_cast<const btConvexShape&>(*other.getCollisionShape());
  const BulletConvex convex(convex_shape, core_);
  convex_in_mesh_ = fromBullet(mesh.getWorldTransform()).inverse() * fromBullet(other.getWorldTransform());
  contacts(shape.tree(), convex, convex_in_mesh_, reach, near_, found);
}

void MeshConvexAlgorithm::toSurfaceContacts(const btCollisionObjectWrapper& mesh,
                                            const btCollisionObjectWrapper& other, double reach,
                                            std::vector<Contact>& found) {
  const auto& shape = static_cast<const ClusteredOctreeShape&>(*mesh.getCollisionShape());
  const BulletConvex convex(static_cast<const btConvexShape&>(*other.getCollisionShape()), core_);
  if (shape.isSolid()) toSolidContacts(shape.tree(), convex, convex_in_mesh_, middle_, found);
  const std::size_t of_triangles = found.size();
  addFlatContacts(shape.tree().mesh(), convex, convex_in_mesh_, reach, of_triangles, found);
  addCornerContacts(shape.tree().mesh(), core_.feet(), convex.radius(), convex_in_mesh_, reach, of_triangles,
                    found);
  internal_edges_.removeFrom(found, shape.tree().mesh());
}

}  // namespace octoblisk::detail
