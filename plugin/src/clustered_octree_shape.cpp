#include "octoblisk_bullet/clustered_octree_shape.h"

#include <BulletCollision/CollisionShapes/btStridingMeshInterface.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <LinearMath/btAabbUtil2.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "cast_callbacks.h"
#include "contact/far_vertices.h"
#include "contact/mesh_features.h"
#include "contact/solid_mesh.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/convex.h"
#include "octoblisk/inspection.h"
#include "octoblisk/mass_properties.h"
#include "octoblisk/triangles_in_box.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/mesh_interface.h"
#include "query/simple_solid.h"
#include "query/thickness.h"

namespace octoblisk {

using namespace detail;

namespace {

std::shared_ptr<const TriangleMesh> scaled(const std::shared_ptr<const TriangleMesh>& mesh,
                                           const Vec3& scaling) {
  if (scaling == Vec3::Ones()) return mesh;
  std::vector<Vec3> vertices = mesh->vertices();
  for (Vec3& vertex : vertices) vertex = vertex.cwiseProduct(scaling);
  std::vector<TriangleMesh::Indices> triangles = mesh->triangles();
  if ((scaling.array() < 0.0).count() % 2 == 1) {
    for (TriangleMesh::Indices& corners : triangles) std::swap(corners[1], corners[2]);
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

/// Whether contacts can push bodies out of the mesh.
bool isOutwardSolid(const MassProperties& properties) {
  return properties.is_solid && !properties.faces_inward;
}

/// A margin that is thin in comparison with the mesh.
double thinMargin(const ClusteredOctree& tree) {
  return std::min(0.01 * tree.mesh().bounds().halfExtents().maxCoeff(), 0.1 * thinThickness(tree));
}

const btStridingMeshInterface& notNull(const btStridingMeshInterface* mesh_interface) {
  if (!mesh_interface) throw std::invalid_argument("ClusteredOctreeShape: the mesh interface is null");
  return *mesh_interface;
}

std::shared_ptr<const ClusteredOctree> notNull(std::shared_ptr<const ClusteredOctree> tree) {
  if (!tree) throw std::invalid_argument("ClusteredOctreeShape: the tree is null");
  return tree;
}

}  // namespace

ClusteredOctreeShape::ClusteredOctreeShape(const btStridingMeshInterface* mesh_interface,
                                           const BuildOptions& options)
    : ClusteredOctreeShape(mesh_interface, notNull(mesh_interface).getScaling(), options) {}

ClusteredOctreeShape::ClusteredOctreeShape(const btStridingMeshInterface* mesh_interface,
                                           const btVector3& scaling, const BuildOptions& options)
    : ClusteredOctreeShape(readMeshInterface(notNull(mesh_interface)), scaling, options) {}

ClusteredOctreeShape::ClusteredOctreeShape(InterfaceMesh source, const btVector3& scaling,
                                           const BuildOptions& options)
    : options_(options),
      unscaled_(std::make_shared<const TriangleMesh>(std::move(source.mesh))),
      parts_(std::move(source.part_begin), unscaled_->triangleCount()) {
  m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
  setLocalScaling(scaling);
}

ClusteredOctreeShape::ClusteredOctreeShape(std::shared_ptr<const ClusteredOctree> tree,
                                           std::vector<std::uint32_t> part_begin)
    : options_(notNull(tree)->options()),
      unscaled_(tree->sharedMesh()),
      parts_(std::move(part_begin), unscaled_->triangleCount()) {
  m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
  use(std::move(tree));
}

void ClusteredOctreeShape::use(std::shared_ptr<const ClusteredOctree> tree, bool may_be_solid) {
  const bool is_simple = isSimpleSolid(tree->mesh());
  std::shared_ptr<const Surface> surface;
  if (may_be_solid && !is_simple) surface = std::make_shared<const Surface>(*tree, options_.threads);
  auto properties = std::make_shared<const MassProperties>(is_simple ? massPropertiesOfSimple(tree->mesh())
                                                           : surface ? octoblisk::massProperties(*surface)
                                                                     : massPropertiesOfBox(tree->mesh()));
  auto vertices = std::make_shared<const FarVertices>(detail::farVertices(*tree));
  auto features = std::make_shared<detail::MeshFeaturesOnFirstUse>();
  const bool is_anywhere_solid = surface ? SolidMesh(*surface).boundsAnywhere() : isOutwardSolid(*properties);
  const bool is_open = !is_anywhere_solid && (!may_be_solid || (surface && !surface->isOriented()));
  if (!is_anywhere_solid) surface = nullptr;
  thin_margin_ = is_anywhere_solid ? btScalar(thinMargin(surface ? surface->boundary() : *tree)) : 0;
  // Nothing below throws, so that the shape stays consistent.
  mass_properties_ = std::move(properties);
  far_vertices_ = std::move(vertices);
  features_ = std::move(features);
  surface_ = std::move(surface);
  is_anywhere_solid_ = is_anywhere_solid;
  is_open_ = is_open;
  tree_ = std::move(tree);
  updateDefaultMargin();
}

void ClusteredOctreeShape::updateDefaultMargin() {
  if (!has_default_margin_) return;
  const bool has_threshold = contact_breaking_threshold_ >= 0;
  const btScalar breaking = has_threshold ? contact_breaking_threshold_ : gContactBreakingThreshold;
  m_collisionMargin = std::min(thin_margin_, breaking / 2);
}

void ClusteredOctreeShape::refit(const btStridingMeshInterface* mesh_interface) {
  InterfaceMesh source = readMeshInterface(notNull(mesh_interface));
  const TriangleParts parts(std::move(source.part_begin), source.mesh.triangleCount());
  auto mesh = std::make_shared<const TriangleMesh>(std::move(source.mesh));
  if (mesh->triangleCount() == unscaled_->triangleCount() && parts != parts_) {
    throw std::invalid_argument("ClusteredOctreeShape: to refit, triangles must stay in their parts");
  }
  refit(std::move(mesh));
}

void ClusteredOctreeShape::refit(std::shared_ptr<const TriangleMesh> unscaled) {
  if (!unscaled) throw std::invalid_argument("ClusteredOctreeShape: the mesh to refit to is null");
  if (unscaled->triangleCount() != unscaled_->triangleCount()) {
    throw std::invalid_argument("ClusteredOctreeShape: refit with " +
                                std::to_string(unscaled->triangleCount()) + " triangles; the shape has " +
                                std::to_string(unscaled_->triangleCount()));
  }
  use(std::make_shared<const ClusteredOctree>(
          tree_->refitted(scaled(unscaled, fromBullet(scaling_)), options_.threads)),
      !is_open_);
  unscaled_ = std::move(unscaled);
}

btScalar ClusteredOctreeShape::getContactBreakingThreshold(btScalar default_factor) const {
  if (contact_breaking_threshold_ >= 0) return contact_breaking_threshold_;
  return std::min(gContactBreakingThreshold, getAngularMotionDisc() * default_factor);
}

void ClusteredOctreeShape::setContactBreakingThreshold(btScalar threshold) {
  contact_breaking_threshold_ = threshold;
  updateDefaultMargin();
}

void ClusteredOctreeShape::setMargin(btScalar margin) {
  has_default_margin_ = false;
  btConcaveShape::setMargin(margin);
}

void ClusteredOctreeShape::setSolid(bool solid) {
  if (solid == may_be_solid_) return;
  features_ = std::make_shared<detail::MeshFeaturesOnFirstUse>();
  may_be_solid_ = solid;
}

std::string ClusteredOctreeShape::whyNotSolid() const {
  if (isSolid()) return "";
  if (!may_be_solid_) return "setSolid(false) was called.";
  const std::string why =
      octoblisk::whyNotSolid(inspect(surface_ ? *surface_ : Surface(*tree_, options_.threads)));
  return why.empty() ? "The mesh had holes when the shape was built." : why;
}

bool ClusteredOctreeShape::isSolid() const { return may_be_solid_ && isOutwardSolid(*mass_properties_); }

const MeshFeatures& ClusteredOctreeShape::features() const { return features_->of(solid()); }

SolidMesh ClusteredOctreeShape::solid() const {
  if (!may_be_solid_ || !is_anywhere_solid_) return {*tree_, SolidMesh::Kind::sheet};
  return surface_ ? SolidMesh(*surface_) : SolidMesh(*tree_, SolidMesh::Kind::simple);
}

btVector3 ClusteredOctreeShape::localGetSupportingVertexWithoutMargin(const btVector3& direction) const {
  return toBullet(farthest(far_vertices_->positions, fromBullet(direction)));
}

void ClusteredOctreeShape::getAabb(const btTransform& transform, btVector3& aabb_min,
                                   btVector3& aabb_max) const {
  const Aabb& bounds = tree_->mesh().bounds();
  // Far from the origin, this box and those of other bodies are rounded by more than Bullet allows for.
  const double farthest = double(transform.getOrigin().length()) + bounds.farthestFromOrigin();
  const btScalar rounding = 2 * SIMD_EPSILON * btScalar(farthest);
  const btScalar reach = getMargin() + std::max(contact_breaking_threshold_, btScalar(0)) + rounding;
  btTransformAabb(toBullet(bounds.min), toBullet(bounds.max), reach, transform, aabb_min, aabb_max);
}

void ClusteredOctreeShape::setLocalScaling(const btVector3& scaling) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isfinite(scaling[axis]) && scaling[axis] != btScalar(0)) continue;
    throw std::invalid_argument("ClusteredOctreeShape: a scaling must be finite and not 0");
  }
  if (tree_ && scaling == scaling_) return;
  use(std::make_shared<const ClusteredOctree>(
      ClusteredOctree::build(scaled(unscaled_, fromBullet(scaling)), options_)));
  scaling_ = scaling;
}

void ClusteredOctreeShape::calculateLocalInertia(btScalar mass, btVector3& inertia) const {
  inertia = toBullet(double(mass) * mass_properties_->inertiaAbout(Vec3::Zero()).diagonal());
}

void ClusteredOctreeShape::calculatePrincipalAxisTransform(btScalar mass, btTransform& principal,
                                                           btVector3& inertia) const {
  const PrincipalFrame frame = principalFrame(*mass_properties_);
  principal = toBullet(frame.in_mesh);
  inertia = toBullet(double(mass) * frame.moments);
}

void ClusteredOctreeShape::processAllTriangles(btTriangleCallback* callback, const btVector3& aabb_min,
                                               const btVector3& aabb_max) const {
  const TriangleMesh& mesh = tree_->mesh();
  // Callers that want all triangles pass boxes of any size, even infinite ones.
  const Aabb box{fromBullet(aabb_min).cwiseMax(mesh.bounds().min),
                 fromBullet(aabb_max).cwiseMin(mesh.bounds().max)};
  if (box.isEmpty()) return;
  TriangleHandover hand_over(*tree_, parts_, box);
  if (castTriangles(*callback, hand_over)) return;
  forEachTriangleIn(*tree_, obbOf(box), 0.0, [&](std::uint32_t triangle) {
    hand_over(*callback, triangle);
    return false;
  });
}

}  // namespace octoblisk
