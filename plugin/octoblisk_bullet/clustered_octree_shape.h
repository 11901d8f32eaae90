// The concave collision shape: stands where btBvhTriangleMeshShape or btGImpactMeshShape stands, and may
// move.
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <memory>
#include <vector>

#include "octoblisk/clustered_octree.h"

class btStridingMeshInterface;

namespace octoblisk {

/// Where a triangle of the shape comes from: the part of the mesh interface and the index within it, as
/// Bullet's callbacks number them.
struct TriangleId {
  int part = 0;
  int index = 0;
};

/// A concave mesh that may be static, kinematic or dynamic. Needs registerAlgorithm (register.h) once for
/// each dispatcher. The tree is immutable: shapes, bodies, worlds and threads may share it.
ATTRIBUTE_ALIGNED16(class)
ClusteredOctreeShape final : public btConcaveShape {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  /// Copies the triangles out of the interface, its scaling included, and builds the tree; the interface is
  /// not needed afterwards. Throws std::invalid_argument for a null or unusable interface (mesh_interface.h)
  /// and for what ClusteredOctree::build refuses.
  explicit ClusteredOctreeShape(const btStridingMeshInterface* mesh_interface,
                                const BuildOptions& options = {});

  /// Shares a tree that is built. Throws std::invalid_argument for a null tree.
  explicit ClusteredOctreeShape(std::shared_ptr<const ClusteredOctree> tree);

  const ClusteredOctree& tree() const { return *tree_; }
  const std::shared_ptr<const ClusteredOctree>& sharedTree() const { return tree_; }

  /// Part and index of a triangle of the tree's mesh.
  TriangleId triangleId(std::uint32_t triangle) const;

  /// Contacts are made, and kept, up to this distance, in world units; Bullet takes the smaller of two
  /// shapes'. Default: gContactBreakingThreshold (0.02), or a fiftieth of the shape's radius where that is
  /// less.
  void setContactBreakingThreshold(btScalar threshold) { contact_breaking_threshold_ = threshold; }
  btScalar getContactBreakingThreshold(btScalar default_factor) const override;

  /// Grown by the margin and by a breaking threshold that was set, so that the broadphase loses no near
  /// contact.
  void getAabb(const btTransform& transform, btVector3& aabb_min, btVector3& aabb_max) const override;

  /// Builds a tree over the scaled triangles for this shape alone; negative factors turn the triangles, so
  /// that they keep facing outward. Throws std::invalid_argument for a factor that is 0 or not
  /// finite.
  void setLocalScaling(const btVector3& scaling) override;
  const btVector3& getLocalScaling() const override { return scaling_; }

  /// The inertia of the solid bounding box.
  void calculateLocalInertia(btScalar mass, btVector3 & inertia) const override;

  /// Calls back once for every triangle that meets the box, and for some near it, in the shape's frame.
  void processAllTriangles(btTriangleCallback * callback, const btVector3& aabb_min,
                           const btVector3& aabb_max) const override;

  const char* getName() const override { return "ClusteredOctree"; }

 private:
  ClusteredOctreeShape(const btStridingMeshInterface& mesh_interface, const BuildOptions& options);

  BuildOptions options_;
  std::shared_ptr<const TriangleMesh> unscaled_;
  std::vector<std::uint32_t> part_begin_ = {0};
  btVector3 scaling_ = btVector3(1, 1, 1);
  btScalar contact_breaking_threshold_ = -1;  // below 0: the default
  std::shared_ptr<const ClusteredOctree> tree_;
};

}  // namespace octoblisk
