// The clustered octree: a bounding volume hierarchy of oriented boxes, built by recursive k-means clustering.
// The paper calls it an octree.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "octoblisk/build_options.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk {

namespace detail {
class Tree;
struct TreeAccess;
}  // namespace detail

/// The size of a tree.
struct BuildStats {
  std::size_t triangles = 0;
  std::size_t nodes = 0;
  std::size_t leaves = 0;
  int depth = 0;             ///< the greatest number of boxes around a triangle
  double root_volume = 0.0;  ///< volume of the box around the whole mesh, mesh units cubed
  double leaf_volume = 0.0;  ///< sum of the volumes of all leaf boxes
  std::size_t bytes = 0;     ///< memory of the tree, without the mesh
};

/// A bounding volume hierarchy over the triangles of a mesh. A node has up to eight children; each has its
/// own oriented box, which contains its triangles entirely. Immutable; any number of threads may query it at
/// once. Copies share its memory.
class ClusteredOctree {
 public:
  /// The greatest number of boxes from the root to a leaf.
  static constexpr int kMaxDepth = 64;
  static constexpr std::size_t kMaxTriangles = std::size_t{1} << 28;

  /// Builds the tree over all triangles of the mesh and shares the mesh. Deterministic. Throws
  /// std::invalid_argument if the mesh is null or has more than kMaxTriangles triangles, or if an option is
  /// out of range.
  static ClusteredOctree build(std::shared_ptr<const TriangleMesh> mesh, const BuildOptions& options = {});

  /// The tree refitted to a mesh with the same triangles but moved vertices. Every box keeps its axes and its
  /// triangles; its size and position are fitted again. Several times faster than building. Queries stay
  /// correct, but become slower the farther the vertices have moved. Deterministic. `threads`: see
  /// BuildOptions. Throws std::invalid_argument if the mesh is null, if the number of vertices or triangles
  /// differs, if a triangle has other vertices, or if `threads` is negative.
  ClusteredOctree refitted(std::shared_ptr<const TriangleMesh> deformed, int threads = 0) const&;

  /// The same, reusing this tree's memory unless another tree shares it: `tree =
  /// std::move(tree).refitted(mesh)`. If it throws std::invalid_argument, this tree is unchanged.
  ClusteredOctree refitted(std::shared_ptr<const TriangleMesh> deformed, int threads = 0) &&;

  const TriangleMesh& mesh() const;
  const std::shared_ptr<const TriangleMesh>& sharedMesh() const;
  const BuildOptions& options() const;
  const BuildStats& stats() const;

  /// Checks that every triangle is in exactly one leaf, that every box contains the vertices of all triangles
  /// below it, that the leaves store the mesh's corners, and that the depth is bounded. Throws
  /// std::logic_error, whose message names the node or triangle.
  void validate() const;

  /// The boxes at a depth (the root's box has depth 0) and the leaf boxes above that depth, in the mesh's
  /// frame. A negative depth counts as 0.
  std::vector<Obb> boxes(int depth) const;

 private:
  friend struct detail::TreeAccess;
  explicit ClusteredOctree(std::shared_ptr<detail::Tree> tree);

  std::shared_ptr<detail::Tree> tree_;
};

}  // namespace octoblisk
