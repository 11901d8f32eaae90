#include "octoblisk_bullet/clustered_octree_shape.h"

#include <BulletCollision/CollisionShapes/btStridingMeshInterface.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <LinearMath/btAabbUtil2.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "octoblisk/triangles_in_box.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/mesh_interface.h"

namespace octoblisk {
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

const btStridingMeshInterface& notNull(const btStridingMeshInterface* mesh_interface) {
  if (!mesh_interface) throw std::invalid_argument("ClusteredOctreeShape: the mesh interface is null");
  return *mesh_interface;
}

}  // namespace

ClusteredOctreeShape::ClusteredOctreeShape(const btStridingMeshInterface* mesh_interface,
                                           const BuildOptions& options)
    : ClusteredOctreeShape(notNull(mesh_interface), options) {}

ClusteredOctreeShape::ClusteredOctreeShape(const btStridingMeshInterface& mesh_interface,
                                           const BuildOptions& options)
    : options_(options) {
  m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
  InterfaceMesh source = readMeshInterface(mesh_interface);
  part_begin_ = std::move(source.part_begin);
  unscaled_ = std::make_shared<const TriangleMesh>(std::move(source.mesh));
  setLocalScaling(mesh_interface.getScaling());
}

ClusteredOctreeShape::ClusteredOctreeShape(std::shared_ptr<const ClusteredOctree> tree)
    : tree_(std::move(tree)) {
  if (!tree_) throw std::invalid_argument("ClusteredOctreeShape: the tree is null");
  m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
  options_ = tree_->options();
  unscaled_ = tree_->sharedMesh();
}

TriangleId ClusteredOctreeShape::triangleId(std::uint32_t triangle) const {
  const auto next_part = std::ranges::upper_bound(part_begin_, triangle);
  const auto part = static_cast<int>(next_part - part_begin_.begin()) - 1;
  return {part, static_cast<int>(triangle - *(next_part - 1))};
}

btScalar ClusteredOctreeShape::getContactBreakingThreshold(btScalar default_factor) const {
  if (contact_breaking_threshold_ >= 0) return contact_breaking_threshold_;
  return std::min(gContactBreakingThreshold, getAngularMotionDisc() * default_factor);
}

void ClusteredOctreeShape::getAabb(const btTransform& transform, btVector3& aabb_min,
                                   btVector3& aabb_max) const {
  const Aabb& bounds = tree_->mesh().bounds();
  const btScalar reach = getMargin() + std::max(contact_breaking_threshold_, btScalar(0));
  btTransformAabb(toBullet(bounds.min), toBullet(bounds.max), reach, transform, aabb_min, aabb_max);
}

void ClusteredOctreeShape::setLocalScaling(const btVector3& scaling) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isfinite(scaling[axis]) && scaling[axis] != btScalar(0)) continue;
    throw std::invalid_argument("ClusteredOctreeShape: a scaling must be finite and not 0");
  }
  if (tree_ && scaling == scaling_) return;
  tree_ = std::make_shared<const ClusteredOctree>(
      ClusteredOctree::build(scaled(unscaled_, fromBullet(scaling)), options_));
  scaling_ = scaling;
}

void ClusteredOctreeShape::calculateLocalInertia(btScalar mass, btVector3& inertia) const {
  const Vec3 edges = 2.0 * tree_->mesh().bounds().halfExtents();
  const Vec3 squares = edges.cwiseAbs2();
  inertia = toBullet(double(mass) / 12.0 *
                     Vec3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y()));
}

void ClusteredOctreeShape::processAllTriangles(btTriangleCallback* callback, const btVector3& aabb_min,
                                               const btVector3& aabb_max) const {
  const TriangleMesh& mesh = tree_->mesh();
  // Callers that want everything pass boxes of any size, infinite ones too.
  const Aabb box{fromBullet(aabb_min).cwiseMax(mesh.bounds().min),
                 fromBullet(aabb_max).cwiseMin(mesh.bounds().max)};
  if ((box.min.array() > box.max.array()).any()) return;
  forEachTriangleIn(*tree_, {box.center(), Mat3::Identity(), box.halfExtents()}, 0.0, [&](std::uint32_t t) {
    const Triangle triangle = mesh.triangle(t);
    Aabb bounds;
    for (const Vec3& corner : triangle) bounds.extend(corner);
    if ((bounds.min.array() > box.max.array()).any() || (bounds.max.array() < box.min.array()).any()) {
      return false;
    }
    btVector3 corners[3] = {toBullet(triangle[0]), toBullet(triangle[1]), toBullet(triangle[2])};
    const TriangleId id = triangleId(t);
    callback->processTriangle(corners, id.part, id.index);
    return false;
  });
}

}  // namespace octoblisk
