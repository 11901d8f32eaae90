// The concave collision shape. It replaces btBvhTriangleMeshShape and btGImpactMeshShape, and may move.
//
// This header includes Bullet and no Eigen, to compile fast. Include octoblisk/clustered_octree.h and
// octoblisk/mass_properties.h to use what tree() and massProperties() return.
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <memory>
#include <vector>

#include "octoblisk/build_options.h"
#include "octoblisk_bullet/triangle_parts.h"

class btStridingMeshInterface;

namespace octoblisk {

class ClusteredOctree;
class TriangleMesh;
struct InterfaceMesh;
struct MassProperties;

namespace detail {
struct FarVertices;
}

/// A concave mesh that may be static, kinematic or dynamic. Needs registerAlgorithm (register.h) once for
/// each dispatcher. The tree is immutable: shapes, bodies, worlds and threads may share it; setLocalScaling
/// and refit give this shape another. Queries are const and compute nothing lazily.
ATTRIBUTE_ALIGNED16(class)
ClusteredOctreeShape final : public btConcaveShape {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  /// Copies the triangles out of the interface, its scaling included, and builds the tree; the interface is
  /// not needed afterwards. Throws std::invalid_argument for a null or unusable interface (mesh_interface.h),
  /// more parts or triangles than Bullet can number (triangle_parts.h), and for what ClusteredOctree::build
  /// refuses.
  explicit ClusteredOctreeShape(const btStridingMeshInterface* mesh_interface,
                                const BuildOptions& options = {});

  /// Shares a tree that is built, or mapped from a file (octoblisk/tree_blob.h): the mesh it is for, and the
  /// first triangles of its parts, readMeshInterface gives. Throws std::invalid_argument for a null tree, and
  /// as TriangleParts does.
  explicit ClusteredOctreeShape(std::shared_ptr<const ClusteredOctree> tree,
                                std::vector<std::uint32_t> part_begin = {0});

  const ClusteredOctree& tree() const { return *tree_; }
  /// Another tree whenever triangles move in the shape's frame: what was found in the last one is invalid.
  const std::shared_ptr<const ClusteredOctree>& sharedTree() const { return tree_; }

  /// Part and index of a triangle of the tree's mesh.
  TriangleId triangleId(std::uint32_t triangle) const { return parts_.id(triangle); }
  const TriangleParts& parts() const { return parts_; }

  /// The mesh before it was scaled.
  const TriangleMesh& unscaledMesh() const { return *unscaled_; }

  /// Fits the tree to vertices that have moved: those of the mesh that the shape was made of, with the same
  /// parts and triangles; the shape's own scaling applies, the interface's does not. Several times faster
  /// than a new shape. Only this shape changes, not others that share its tree. Not while a query runs. A
  /// static or sleeping body is to be told as of any change: its bounds (updateSingleAabb), its activation.
  /// Throws std::invalid_argument for null, for another number of triangles or parts, and as
  /// ClusteredOctree::refitted does; the shape is then as it was.
  void refit(const btStridingMeshInterface* mesh_interface);
  /// The same of a mesh of the core.
  void refit(std::shared_ptr<const TriangleMesh> unscaled);

  /// In a step, contacts are created within half this distance and kept within all of it, in world units.
  /// contactTest and contactPairTest find contacts within all of it. Bullet takes the smaller distance of two
  /// shapes. Default: gContactBreakingThreshold (0.02), or a fiftieth of the shape's radius where that is
  /// less.
  void setContactBreakingThreshold(btScalar threshold) { contact_breaking_threshold_ = threshold; }
  btScalar getContactBreakingThreshold(btScalar default_factor) const override;

  /// The thickness of a skin round the triangles, in world units. Bodies rest on it, and their meshes stay
  /// out of each other. Default: 0 for an open mesh. For a closed one a hundredth of the greatest half
  /// extent, or a tenth of the thickness of its thin parts if that is less; it changes with the scaling and
  /// with refit. 0 makes contacts exact on the triangles.
  void setMargin(btScalar margin) override;

  /// A closed mesh is a solid unless this says otherwise: a body that gets inside is pushed out the shortest
  /// way. A surface has no inside; a body that gets through it in one step stays there. An open mesh is
  /// always a surface.
  void setSolid(bool solid) { may_be_solid_ = solid; }
  bool isSolid() const;

  /// Grown by the margin and by a breaking threshold that was set, so that the broadphase loses no near
  /// contact.
  void getAabb(const btTransform& transform, btVector3& aabb_min, btVector3& aabb_max) const override;

  /// Builds a tree over the scaled triangles for this shape alone; negative factors turn the triangles, so
  /// that they keep facing outward. Throws std::invalid_argument for a factor that is 0 or not
  /// finite, and as ClusteredOctree::build does; the shape is then as it was.
  void setLocalScaling(const btVector3& scaling) override;
  const btVector3& getLocalScaling() const override { return scaling_; }

  /// Of the solid within the mesh (octoblisk/mass_properties.h) about the shape's origin, where a body has
  /// its centre of mass, exact; of the solid bounding box where the mesh is not closed. Bullet knows the
  /// diagonal alone: products of inertia are dropped. calculatePrincipalAxisTransform tells where to put the
  /// shape so that there are none.
  void calculateLocalInertia(btScalar mass, btVector3 & inertia) const override;

  /// As btCompoundShape's of the same name: the frame, in the shape's, of centre of mass and principal axes,
  /// and the inertia of the mass in it. A body moves as the solid does whose shape is a compound with this
  /// shape as its child at principal.inverse(), or a shape whose vertices were moved so.
  void calculatePrincipalAxisTransform(btScalar mass, btTransform & principal, btVector3 & inertia) const;

  /// In the shape's frame, scaled as it is.
  const MassProperties& massProperties() const { return *mass_properties_; }
  const detail::FarVertices& farVertices() const { return *far_vertices_; }

  /// Calls back once for every triangle that meets the box, and for some near it, in the shape's frame. The
  /// callbacks of Bullet's ray tests and convex sweeps are given the triangles on their way alone.
  void processAllTriangles(btTriangleCallback * callback, const btVector3& aabb_min,
                           const btVector3& aabb_max) const override;

  /// Writes a btTriangleMeshShapeData of the unscaled mesh, its parts and the scaling: stock importers make a
  /// btBvhTriangleMeshShape of it, WorldImporter (world_importer.h) this shape again. Vertices are written as
  /// doubles in either precision, so that a saved tree (octoblisk/tree_blob.h) goes with what is read back.
  int calculateSerializeBufferSize() const override;
  const char* serialize(void* buffer, btSerializer* serializer) const override;

  const char* getName() const override { return "ClusteredOctree"; }

 private:
  ClusteredOctreeShape(InterfaceMesh source, const btVector3& scaling, const BuildOptions& options);
  void use(std::shared_ptr<const ClusteredOctree> tree);

  BuildOptions options_;
  std::shared_ptr<const TriangleMesh> unscaled_;
  TriangleParts parts_;
  btVector3 scaling_ = btVector3(1, 1, 1);
  btScalar contact_breaking_threshold_ = -1;  // below 0: the default
  std::shared_ptr<const ClusteredOctree> tree_;
  std::shared_ptr<const MassProperties> mass_properties_;
  std::shared_ptr<const detail::FarVertices> far_vertices_;
  bool may_be_solid_ = true;
  bool has_default_margin_ = true;
};

}  // namespace octoblisk
