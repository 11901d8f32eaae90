// The clustered octree: a wide (8-child) bounding volume hierarchy of oriented boxes, built by recursive
// k-means clustering. "Octree" is the paper's word. Any number of threads may query a tree; copies share its
// memory.
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

/// What a tree is made of.
struct BuildStats {
  std::size_t triangles = 0;
  std::size_t nodes = 0;
  std::size_t leaves = 0;
  int depth = 0;             ///< boxes round a leaf, its own included
  double root_volume = 0.0;  ///< of the box round all, mesh units cubed
  double leaf_volume = 0.0;  ///< of all leaf boxes together
  std::size_t bytes = 0;     ///< of the tree beside the mesh
};

/// The tree over the triangles of a mesh: up to eight children a node, each in an oriented box of its own
/// that holds its whole triangles. Immutable; any number of threads may ask it at once.
class ClusteredOctree {
 public:
  /// Boxes from the root to a leaf at most.
  static constexpr int kMaxDepth = 64;
  static constexpr std::size_t kMaxTriangles = std::size_t{1} << 28;

  /// Builds the tree over all triangles of the mesh, which it shares. Deterministic.
  /// Throws std::invalid_argument for no mesh, more than kMaxTriangles triangles, or an option out of its
  /// range.
  static ClusteredOctree build(std::shared_ptr<const TriangleMesh> mesh, const BuildOptions& options = {});

  /// The tree of a mesh of the same triangles whose vertices have moved: every box keeps its axes and what it
  /// holds, and is made to fit again. Several times faster than building; the farther the vertices have moved
  /// the slower are queries, never wrong. Deterministic. `threads` as in BuildOptions.
  /// Throws std::invalid_argument for no mesh, another number of vertices or triangles, a triangle with other
  /// vertices, or a negative number of threads.
  ClusteredOctree refitted(std::shared_ptr<const TriangleMesh> deformed, int threads = 0) const&;

  /// The same in this tree's memory, if it shares that with no other: `tree =
  /// std::move(tree).refitted(mesh)`. Where it throws, this tree is as it was.
  ClusteredOctree refitted(std::shared_ptr<const TriangleMesh> deformed, int threads = 0) &&;

  const TriangleMesh& mesh() const;
  const std::shared_ptr<const TriangleMesh>& sharedMesh() const;
  const BuildOptions& options() const;
  const BuildStats& stats() const;

  /// Checks that every triangle is in exactly one leaf, that every box holds the vertices of all triangles
  /// below it, that the leaves' corners are those of the mesh, and that the depth is bounded. Throws
  /// std::logic_error that names the node or triangle.
  void validate() const;

  /// The boxes at a depth (the root's box is 0), and those of leaves above it; in the mesh's frame.
  std::vector<Obb> boxes(int depth) const;

 private:
  friend struct detail::TreeAccess;
  explicit ClusteredOctree(std::shared_ptr<detail::Tree> tree);

  std::shared_ptr<detail::Tree> tree_;
};

}  // namespace octoblisk
