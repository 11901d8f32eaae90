// The clustered octree: up to eight children a node, each with an oriented box of its own that holds its
// whole triangles. Built once, never changed: const queries from any number of threads may share it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "octoblisk/box8.h"
#include "octoblisk/build_options.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk {

struct BuildStats {
  std::size_t triangles = 0;
  std::size_t nodes = 0;
  std::size_t leaves = 0;
  int depth = 0;             ///< boxes round a leaf, its own included
  double root_volume = 0.0;  ///< of the box round all, mesh units cubed
  double leaf_volume = 0.0;  ///< of all leaf boxes together
  std::size_t bytes = 0;     ///< of the tree beside the mesh
};

/// What a box of a node holds: another node, a leaf of 1..8 triangles, or nothing.
class Child {
 public:
  Child() = default;
  static Child node(std::uint32_t index) { return Child(index); }
  static Child leaf(std::uint32_t first, std::uint32_t count) {
    return Child(kLeafBit | first << 3 | (count - 1));
  }

  bool isLeaf() const { return (bits_ & kLeafBit) != 0; }
  bool isEmpty() const { return bits_ == 0; }
  std::uint32_t node() const { return bits_; }
  std::uint32_t first() const { return (bits_ & ~kLeafBit) >> 3; }  ///< of a leaf, in triangleOrder()
  std::uint32_t count() const { return (bits_ & 7u) + 1; }          ///< of a leaf

 private:
  explicit Child(std::uint32_t bits) : bits_(bits) {}
  static constexpr std::uint32_t kLeafBit = 0x80000000u;
  std::uint32_t bits_ = 0;
};

/// One box of one node.
struct Slot {
  std::uint32_t node, lane;
};

/// A node of each of two trees: what hangs from them. By default the whole trees.
struct NodePair {
  std::uint32_t a = 0, b = 0;
};

class ClusteredOctree {
 public:
  struct alignas(64) Node {
    Box8 boxes;
    std::array<Child, kLanes> children;
  };
  static_assert(sizeof(Node) == 512);  // eight cache lines

  /// Boxes from the root to a leaf at most.
  static constexpr int kMaxDepth = 64;
  static constexpr std::size_t kMaxTriangles = std::size_t{1} << 28;

  /// Builds the tree over all triangles of the mesh, which it shares. Deterministic.
  /// Throws std::invalid_argument for no mesh, more than kMaxTriangles triangles, or an option out of its
  /// range.
  static ClusteredOctree build(std::shared_ptr<const TriangleMesh> mesh, const BuildOptions& options = {});

  const TriangleMesh& mesh() const { return *mesh_; }
  const std::shared_ptr<const TriangleMesh>& sharedMesh() const { return mesh_; }
  const BuildOptions& options() const { return options_; }
  const BuildStats& stats() const { return stats_; }

  /// Checks that every triangle is in exactly one leaf, that every box holds the vertices of all triangles
  /// below it, and that the depth is bounded. Throws std::logic_error that names the node or triangle.
  void validate() const;

  /// The boxes at a depth (the root's box is 0), and those of leaves above it; in the mesh's frame.
  std::vector<Obb> boxes(int depth) const;

  // What traversals read. The first node holds the box of the whole tree alone, in lane 0.
  static constexpr Slot kRoot = {0, 0};
  const std::vector<Node>& nodes() const { return nodes_; }
  Child child(Slot slot) const { return nodes_[slot.node].children[slot.lane]; }
  const Box8& boxes(Slot slot) const { return nodes_[slot.node].boxes; }
  std::span<const std::uint32_t> triangleOrder() const { return triangle_order_; }
  std::span<const std::uint32_t> triangles(Child leaf) const {
    return triangleOrder().subspan(leaf.first(), leaf.count());
  }
  /// The corners of a leaf's triangles in the frame of its box: nine rows (x, y, z of each corner in turn) of
  /// count() numbers. Eight may be read from any row, those beyond its end being anything.
  const float* leafVertices(Child leaf) const {
    return leaf_vertices_.data() + 9 * std::size_t{leaf.first()};
  }
  /// The boxes are relative to this point of the mesh's frame.
  const Vec3& origin() const { return origin_; }
  /// The greatest distance of a vertex from the origin.
  double radius() const { return radius_; }
  Obb box(Slot slot) const;

 private:
  ClusteredOctree() = default;
  void writeLeafVertices(std::uint32_t node);
  /// box(slot) relative to the origin: exact, however far away that is.
  Obb localBox(Slot slot) const;

  std::shared_ptr<const TriangleMesh> mesh_;
  Vec3 origin_ = Vec3::Zero();
  double radius_ = 0.0;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> triangle_order_;
  std::vector<float> leaf_vertices_;
  BuildOptions options_;
  BuildStats stats_;
};

}  // namespace octoblisk
