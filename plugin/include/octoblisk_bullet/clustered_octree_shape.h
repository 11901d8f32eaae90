// The concave collision shape. It replaces btBvhTriangleMeshShape and btGImpactMeshShape, and its bodies may
// move.
//
// To compile fast, this header includes Bullet but not Eigen. Include octoblisk/clustered_octree.h and
// octoblisk/mass_properties.h to use what tree() and massProperties() return.
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <memory>
#include <string>
#include <vector>

#include "octoblisk/build_options.h"
#include "octoblisk_bullet/triangle_parts.h"

class btStridingMeshInterface;

namespace octoblisk {

class ClusteredOctree;
class Surface;
class TriangleMesh;
struct InterfaceMesh;
struct MassProperties;

namespace detail {
struct FarVertices;
class MeshFeatures;
class MeshFeaturesOnFirstUse;
class SolidMesh;
}  // namespace detail

/// A concave mesh that may be static, kinematic or dynamic. Call registerAlgorithm (register.h) once for each
/// dispatcher. The tree is immutable, so shapes, bodies, worlds and threads may share it. setLocalScaling and
/// refit give this shape a new tree. Queries are const. Only what contacts of two moving meshes need
/// is built on first use, by any thread.
ATTRIBUTE_ALIGNED16(class)
ClusteredOctreeShape final : public btConcaveShape {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  /// Copies the triangles from the interface, applies the interface's scaling, and builds the tree. The
  /// interface is not needed afterwards. Throws std::invalid_argument if the interface is null or unusable
  /// (mesh_interface.h), if it has more parts or triangles than Bullet can number (triangle_parts.h), or if
  /// ClusteredOctree::build refuses the mesh or the options.
  explicit ClusteredOctreeShape(const btStridingMeshInterface* mesh_interface,
                                const BuildOptions& options = {});
  /// The same with this scaling instead of the interface's; throws also as setLocalScaling does.
  ClusteredOctreeShape(const btStridingMeshInterface* mesh_interface, const btVector3& scaling,
                       const BuildOptions& options = {});

  /// Shares a tree that was built before or mapped from a file (octoblisk/tree_blob.h). readMeshInterface
  /// returns the mesh for such a tree and `part_begin`, the first triangle of each part. Throws
  /// std::invalid_argument if the tree is null, or as TriangleParts does.
  explicit ClusteredOctreeShape(std::shared_ptr<const ClusteredOctree> tree,
                                std::vector<std::uint32_t> part_begin = {0});

  const ClusteredOctree& tree() const { return *tree_; }
  /// A new tree replaces it whenever triangles move in the shape's frame; results found in the old tree are
  /// then invalid.
  const std::shared_ptr<const ClusteredOctree>& sharedTree() const { return tree_; }

  /// Part and index of a triangle of the tree's mesh.
  TriangleId triangleId(std::uint32_t triangle) const { return parts_.id(triangle); }
  const TriangleParts& parts() const { return parts_; }

  /// Refits the tree to moved vertices of the shape's mesh; parts and triangles must be the same. Applies the
  /// shape's own scaling, not the interface's. Several times faster than a new shape. Changes only this
  /// shape, not others that share its tree. Do not call it while a query runs. For a static or sleeping body,
  /// also update its bounds (updateSingleAabb) and activate it, as after any change. A mesh with doubled
  /// facets, overlapping parts, T-junctions or some holes is examined again, which takes longer than
  /// building. Throws std::invalid_argument if the argument is null, if the number of triangles or the parts
  /// differ, or as ClusteredOctree::refitted does. The shape is then unchanged.
  void refit(const btStridingMeshInterface* mesh_interface);
  /// The same from a mesh of the core.
  void refit(std::shared_ptr<const TriangleMesh> unscaled);

  /// In a step, contacts are created up to half this distance and kept up to the whole distance, in world
  /// units. contactTest and contactPairTest find contacts up to the whole distance. Bullet uses the smaller
  /// threshold of the two shapes. Default: gContactBreakingThreshold (0.02), or 1/50 of the shape's radius if
  /// that is smaller. The threshold also limits the default margin.
  void setContactBreakingThreshold(btScalar threshold);
  btScalar getContactBreakingThreshold(btScalar default_factor) const override;

  /// The contact margin: the thickness of a layer around the triangles, in world units. Bodies rest on this
  /// layer, so their meshes stay apart. Default: 0 if no triangle bounds a solid (see setSolid). Otherwise,
  /// the least of 1/100 of its greatest half extent, 1/10 of the thickness of its thin parts, and half the
  /// contact breaking threshold (0.01 by default); scaling and refit change it. With a margin of 0, contacts
  /// lie exactly on the triangles.
  ///
  /// If one body is between opposite walls of the other, a step limits the margins of the two. The margins at
  /// both walls together take at most 4/5 of the room. The room is the greatest distance that the body could
  /// move between the walls since the bodies met.
  void setMargin(btScalar margin) override;

  /// By default, a mesh is a solid where its triangles bound one (octoblisk/surface.h): a body that gets
  /// inside is pushed out along the shortest path. Facets may be doubled, parts may overlap, and T-junctions
  /// and narrow cracks do not matter. Around holes, and with setSolid(false) everywhere, the mesh is a
  /// surface, which has no inside: a body that passes through it in one step stays there.
  void setSolid(bool solid);
  /// Whether the mesh is a solid. False after setSolid(false), and if the mesh has holes or no volume, or if
  /// it faces inward as a whole. Also true if a separate part faces inward (`inspect` in
  /// octoblisk/inspection.h lists such triangles): only that part acts differently.
  bool isSolid() const;
  /// Why isSolid() is false, in one sentence that names the first defect; empty if it is true. Examines the
  /// mesh again, so it takes about as long as building the shape.
  std::string whyNotSolid() const;

  /// The box is grown by the margin and by the contact breaking threshold if one was set, so that the
  /// broadphase misses no contact.
  void getAabb(const btTransform& transform, btVector3& aabb_min, btVector3& aabb_max) const override;

  /// Builds a tree over the scaled triangles for this shape alone. If factors mirror the mesh, the triangles
  /// are reversed so that they still face outward. Throws std::invalid_argument if a factor is 0 or not
  /// finite, or as ClusteredOctree::build does. The shape is then unchanged.
  void setLocalScaling(const btVector3& scaling) override;
  const btVector3& getLocalScaling() const override { return scaling_; }

  /// The exact inertia of the solid within the mesh (octoblisk/mass_properties.h) about the shape's origin,
  /// which is the body's centre of mass; if the mesh has holes, that of its solid bounding box. Bullet
  /// uses only the diagonal, so products of inertia are dropped. calculatePrincipalAxisTransform finds a
  /// frame without products of inertia.
  void calculateLocalInertia(btScalar mass, btVector3 & inertia) const override;

  /// Like btCompoundShape's function of the same name: computes the frame of centre of mass and principal
  /// axes, in the shape's frame, and the inertia in it. To make a body move exactly like the solid, give it a
  /// compound that contains this shape at principal.inverse(), or a shape whose vertices were transformed by
  /// principal.inverse().
  void calculatePrincipalAxisTransform(btScalar mass, btTransform & principal, btVector3 & inertia) const;

  /// In the shape's frame, with scaling applied.
  const MassProperties& massProperties() const { return *mass_properties_; }

  /// For the library's own algorithms.
  const detail::FarVertices& farVertices() const { return *far_vertices_; }
  /// The same, built on first use: those of the triangles that bodies collide with.
  const detail::MeshFeatures& features() const;
  /// The same: what bodies collide with. A surface after setSolid(false).
  detail::SolidMesh solid() const;

  /// Calls back once for every triangle that meets the box, in the shape's frame, and for some others nearby.
  /// A callback of Bullet's ray tests receives only the triangles along the ray. A callback of its convex
  /// sweeps receives exact hits instead of triangles.
  void processAllTriangles(btTriangleCallback * callback, const btVector3& aabb_min,
                           const btVector3& aabb_max) const override;

  /// The farthest of farVertices() in a direction; not for users. Bullet's algorithm for two convex shapes
  /// calls this function if setCollisionShape has given a convex body this shape and nobody has cleaned the
  /// body's pairs. Until such a pair ends, the shape acts as the hull of its far vertices. This must stay the
  /// first virtual function that the class adds: btConvexShape has the function of the same name at this
  /// place in its table of virtual functions.
  virtual btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const;

  /// Writes the unscaled mesh, its parts and the scaling as btTriangleMeshShapeData. Bullet's importers
  /// create a btBvhTriangleMeshShape from it; WorldImporter (world_importer.h) restores this shape. Vertices
  /// are written as doubles whatever Bullet's precision is. docs/saving.md says when a saved tree
  /// (octoblisk/tree_blob.h) fits the mesh that is read back.
  int calculateSerializeBufferSize() const override;
  const char* serialize(void* buffer, btSerializer* serializer) const override;

  const char* getName() const override { return "ClusteredOctree"; }

 private:
  ClusteredOctreeShape(InterfaceMesh source, const btVector3& scaling, const BuildOptions& options);
  /// `may_be_solid`: false if no triangle bounds a solid unless the mesh is simple (query/simple_solid.h), so
  /// that it need not be examined.
  void use(std::shared_ptr<const ClusteredOctree> tree, bool may_be_solid = true);
  void updateDefaultMargin();

  BuildOptions options_;
  std::shared_ptr<const TriangleMesh> unscaled_;
  TriangleParts parts_;
  btVector3 scaling_ = btVector3(1, 1, 1);
  btScalar contact_breaking_threshold_ = -1;  // below 0: the default
  std::shared_ptr<const ClusteredOctree> tree_;
  std::shared_ptr<const MassProperties> mass_properties_;
  std::shared_ptr<const detail::FarVertices> far_vertices_;
  std::shared_ptr<detail::MeshFeaturesOnFirstUse> features_;
  std::shared_ptr<const Surface> surface_;  // null if all triangles bound a solid, or none does
  bool is_anywhere_solid_ = false;
  bool is_open_ = false;  // no triangle bounds a solid, and the mesh has open edges
  bool may_be_solid_ = true;
  bool has_default_margin_ = true;
  btScalar thin_margin_ = 0;  // of the mesh; the default margin is no greater
};

}  // namespace octoblisk
