#include "mesh_convex_algorithm.h"

#include "contact/flat_contacts.h"
#include "contact/foot_contacts.h"
#include "contact/solid_contacts.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/contacts.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "shape_bounds.h"

namespace octoblisk::detail {

bool MeshConvexAlgorithm::readOther(const PosedShapes& shapes) {
  const auto& shape = static_cast<const btConvexShape&>(shapes.other);
  const bool has_other_corners = core_.update(shape);
  const Aabb bounds = shapeBounds(shape);
  const btScalar margin = shape.getMarginNonVirtual();
  const bool has_other_size = bounds.min != bounds_.min || bounds.max != bounds_.max || margin != margin_;
  bounds_ = bounds;
  margin_ = margin;
  // Other shapes may change while their corners, bounds and margin stay the same.
  const bool is_known = !core_.points().empty() || shape.getShapeType() == CYLINDER_SHAPE_PROXYTYPE ||
                        shape.getShapeType() == CONE_SHAPE_PROXYTYPE;
  return is_known && !has_other_corners && !has_other_size;
}

void MeshConvexAlgorithm::findTriangleContacts(const PosedShapes& shapes, std::vector<Contact>& found) {
  const BulletConvex convex(static_cast<const btConvexShape&>(shapes.other), core_);
  const ClusteredOctree& tree = shapes.treeOfMesh();
  contacts(tree, near_.find(tree, convex, shapes.other_in_mesh, shapes.reach), convex, shapes.other_in_mesh,
           shapes.reach, found);
}

void MeshConvexAlgorithm::findBodyContacts(const PosedShapes& shapes, std::vector<Contact>& found) {
  findTriangleContacts(shapes, found);
  const ClusteredOctree& tree = shapes.treeOfMesh();
  const BulletConvex convex(static_cast<const btConvexShape&>(shapes.other), core_);
  const Pose& convex_in_mesh = shapes.other_in_mesh;
  const SolidMesh solid = shapes.mesh.solid();
  if (solid.isAnywhereSolid()) toSolidContacts(solid, convex, convex_in_mesh, shapes.reach, middle_, found);
  const std::size_t of_triangles = found.size();
  addFlatContacts(tree.mesh(), convex, convex_in_mesh, shapes.reach, found);
  if (core_.hasFeet()) {
    const auto feet = [this](const Vec3& towards) { return core_.feet(towards); };
    addFootContacts(tree.mesh(), feet, convex.radius(), convex_in_mesh, shapes.reach, of_triangles, found);
  }
  internal_edges_.removeFrom(found, tree.mesh());
}

}  // namespace octoblisk::detail
