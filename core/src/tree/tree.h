// The implementation of ClusteredOctree that queries read.
#pragma once

#include <memory>
#include <span>

#include "octoblisk/clustered_octree.h"
#include "tree/leaf_vertices.h"
#include "tree/tree_arrays.h"

namespace octoblisk::detail {

/// A mesh and the arrays of a tree over it.
class Tree {
 public:
  static constexpr int kMaxDepth = ClusteredOctree::kMaxDepth;
  /// The first node contains only the box of the whole tree, in lane 0.
  static constexpr Slot kRoot = {0, 0};

  Tree(std::shared_ptr<const TriangleMesh> mesh, OwnedArrays arrays, BuildOptions options);
  /// Uses arrays that the owner keeps and never changes.
  Tree(std::shared_ptr<const TriangleMesh> mesh, const TreeArrays& arrays, std::shared_ptr<const void> owner,
       BuildOptions options);
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  const TriangleMesh& mesh() const { return *mesh_; }
  const std::shared_ptr<const TriangleMesh>& sharedMesh() const { return mesh_; }
  const BuildOptions& options() const { return options_; }
  const BuildStats& stats() const { return stats_; }

  const TreeArrays& arrays() const { return arrays_; }
  bool isCompact() const { return arrays_.isCompact(); }
  std::span<const TreeNode> nodes() const { return arrays_.nodes; }  ///< of a full tree, otherwise empty
  std::span<const CompactNode> compactNodes() const { return arrays_.compact_nodes; }
  std::size_t nodeCount() const { return arrays_.nodeCount(); }
  Child child(Slot slot) const { return arrays_.child(slot); }
  std::span<const std::uint32_t> triangleOrder() const { return arrays_.triangle_order; }
  std::span<const std::uint32_t> triangles(Child leaf) const { return arrays_.triangles(leaf); }

  /// The corners of a leaf's triangles in the frame of its box: nine rows (x, y, z of each corner in turn) of
  /// as many numbers as the leaf has triangles. Eight numbers may be read from any row; those beyond its end
  /// are arbitrary. A compact tree computes the corners from the mesh and writes them into `room`.
  const float* leafVertices(Slot slot, LeafVertices& room) const {
    if (!isCompact()) return arrays_.leaf_vertices.data() + 9 * std::size_t{child(slot).first()};
    computeLeafVertices(slot, room);
    return room.rows;
  }

  /// Boxes are relative to this point of the mesh's frame.
  const Vec3& origin() const { return origin_; }
  /// No vertex is farther from the origin.
  double radius() const { return radius_; }
  /// In the mesh's frame.
  Obb box(Slot slot) const;

  /// Whether the tree owns its arrays.
  bool ownsArrays() const { return owner_ == nullptr; }
  /// Refits the tree's own arrays to the mesh, which must be the tree's mesh with moved vertices.
  void refit(std::shared_ptr<const TriangleMesh> deformed, int threads);

 private:
  /// Sets what depends on the positions of the vertices.
  void measure();
  void computeLeafVertices(Slot slot, LeafVertices& room) const;

  std::shared_ptr<const TriangleMesh> mesh_;
  Vec3 origin_;
  double radius_;
  OwnedArrays owned_;                  // empty if another object owns the arrays
  std::shared_ptr<const void> owner_;  // of arrays that the tree does not own
  TreeArrays arrays_;
  BuildOptions options_;
  BuildStats stats_;
};

/// Gives this library access to the implementation of a ClusteredOctree.
struct TreeAccess {
  static const Tree& tree(const ClusteredOctree& octree) { return *octree.tree_; }
  static ClusteredOctree octree(std::shared_ptr<Tree> tree) { return ClusteredOctree(std::move(tree)); }
};

inline const Tree& treeOf(const ClusteredOctree& octree) { return TreeAccess::tree(octree); }

/// A tree over arrays that the owner keeps and never changes, and that any tree of the mesh may have
/// produced. Throws std::invalid_argument, which says what is wrong, if queries on them could fail.
ClusteredOctree octreeOver(std::shared_ptr<const TriangleMesh> mesh, const TreeArrays& arrays,
                           std::shared_ptr<const void> owner, const BuildOptions& options);

}  // namespace octoblisk::detail
