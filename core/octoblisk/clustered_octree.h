// The clustered octree: up to eight children a node, each with an oriented box of its own that holds its
// whole triangles. Built once, never changed: const queries from any number of threads may share it, and
// copies share its memory.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "octoblisk/build_options.h"
#include "octoblisk/leaf_vertices.h"
#include "octoblisk/tree_arrays.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk {

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

/// A node of each of two trees: what hangs from them. By default the whole trees.
struct NodePair {
  std::uint32_t a = 0, b = 0;
};

/// The tree over the triangles of a mesh: up to eight children a node, each in an oriented box of its own
/// that holds its whole triangles. Immutable; any number of threads may ask it at once.
class ClusteredOctree {
 public:
  using Node = TreeNode;

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

  /// The tree over arrays that the owner keeps and never changes, made by any tree of the mesh.
  /// Throws std::invalid_argument that tells what is wrong where queries on them could fail.
  static ClusteredOctree over(std::shared_ptr<const TriangleMesh> mesh, const TreeArrays& arrays,
                              std::shared_ptr<const void> owner, const BuildOptions& options);

  const TriangleMesh& mesh() const { return *mesh_; }
  const std::shared_ptr<const TriangleMesh>& sharedMesh() const { return mesh_; }
  const BuildOptions& options() const { return options_; }
  const BuildStats& stats() const { return stats_; }

  /// Checks that every triangle is in exactly one leaf, that every box holds the vertices of all triangles
  /// below it, that the leaves' corners are those of the mesh, and that the depth is bounded. Throws
  /// std::logic_error that names the node or triangle.
  void validate() const;

  /// The boxes at a depth (the root's box is 0), and those of leaves above it; in the mesh's frame.
  std::vector<Obb> boxes(int depth) const;

  // What traversals read. The first node holds the box of the whole tree alone, in lane 0.
  static constexpr Slot kRoot = {0, 0};
  bool isCompact() const { return arrays_.isCompact(); }
  std::span<const Node> nodes() const { return arrays_.nodes; }  ///< of a fast tree, else none
  std::span<const CompactNode> compactNodes() const { return arrays_.compact_nodes; }
  std::size_t nodeCount() const { return arrays_.nodeCount(); }
  const std::array<Child, kLanes>& children(std::uint32_t node) const { return arrays_.children(node); }
  Child child(Slot slot) const { return arrays_.child(slot); }
  std::span<const std::uint32_t> triangleOrder() const { return arrays_.triangle_order; }
  std::span<const std::uint32_t> triangles(Child leaf) const { return arrays_.triangles(leaf); }
  /// The corners of a leaf's triangles in the frame of its box: nine rows (x, y, z of each corner in turn) of
  /// as many numbers as it has triangles. Eight may be read from any row, those beyond its end being
  /// anything. A compact tree computes them from the mesh, into the room.
  const float* leafVertices(Slot slot, LeafVertices& room) const {
    if (!isCompact()) return arrays_.leaf_vertices.data() + 9 * std::size_t{child(slot).first()};
    computeLeafVertices(slot, room);
    return room.rows;
  }
  /// The boxes are relative to this point of the mesh's frame.
  const Vec3& origin() const { return origin_; }
  /// The greatest distance of a vertex from the origin.
  double radius() const { return radius_; }
  Obb box(Slot slot) const;
  const TreeArrays& arrays() const { return arrays_; }

 private:
  /// `owned` is null where the arrays are the owner's and never change.
  ClusteredOctree(std::shared_ptr<const TriangleMesh> mesh, const TreeArrays& arrays,
                  std::shared_ptr<const void> owner, std::shared_ptr<OwnedArrays> owned,
                  BuildOptions options);
  ClusteredOctree(std::shared_ptr<const TriangleMesh> mesh, std::shared_ptr<OwnedArrays> owned,
                  BuildOptions options);
  void computeLeafVertices(Slot slot, LeafVertices& room) const;

  std::shared_ptr<const TriangleMesh> mesh_;
  Vec3 origin_;
  double radius_;
  TreeArrays arrays_;
  std::shared_ptr<const void> owner_;   // of the arrays, where they are not
  std::shared_ptr<OwnedArrays> owned_;  // these
  BuildOptions options_;
  BuildStats stats_;
};

}  // namespace octoblisk
