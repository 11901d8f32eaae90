// The clusters that one node of the tree is divided into.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "build/box_fit.h"
#include "build/split_finder.h"

namespace octoblisk::detail {

/// A cluster: a range of the indices that were divided.
struct Cluster {
  std::uint32_t begin, end;
  BoxF box;            ///< its frame counts; its extents are approximate unless exact
  bool exact = false;  ///< the box holds all vertices

  std::uint32_t count() const { return end - begin; }
};

/// A cluster was divided by a plane: it became its low side, and the clusters after it moved up by one for
/// its high side.
struct Cut {
  std::size_t cluster;
  SplitFinder::Plane plane;
};

/// Divides the triangles of a node, the widest cluster first, until there are eight, or none has more than
/// `capacity`, or than a node of leaves alone can do with. Keeps its memory from node to node.
class NodeDivider {
 public:
  NodeDivider(std::uint32_t capacity, const SplitEffort& effort) : capacity_(capacity), effort_(effort) {}

  /// The clusters of the records that the indices name, which are put into their order. The last call's
  /// clusters are overwritten.
  const std::vector<Cluster>& byClusters(std::span<const TriangleRecord> records,
                                         std::span<std::uint32_t> indices, const BoxF& box);

  /// The same by medians alone: for nodes too deep for clusters, which need not be balanced.
  const std::vector<Cluster>& byMedians(std::span<const TriangleRecord> records,
                                        std::span<std::uint32_t> indices, const BoxF& box);

  /// The same for a sample: by planes alone, which then can divide other records. One cluster where there is
  /// no plane.
  const std::vector<Cluster>& byPlanes(std::span<const TriangleRecord> records,
                                       std::span<std::uint32_t> sample, const BoxF& box);
  const std::vector<Cut>& cuts() const { return cuts_; }

 private:
  enum class Method { clusters, medians, planes };
  const std::vector<Cluster>& divide(std::span<const TriangleRecord> records,
                                     std::span<std::uint32_t> indices, const BoxF& box, Method method);
  bool cut(std::size_t cluster);
  void halve(std::size_t cluster);
  void replace(std::size_t cluster, std::uint32_t mid, const BoxF& low, const BoxF& high, bool exact);
  template <typename IsLow>
  std::uint32_t separate(std::span<std::uint32_t> indices, const IsLow& is_low);
  BoxF fitted(std::span<const std::uint32_t> indices);

  const std::uint32_t capacity_;
  const SplitEffort effort_;
  SplitFinder finder_;
  VertexSample vertices_;
  std::vector<std::uint32_t> high_;

  std::span<const TriangleRecord> records_;
  std::span<std::uint32_t> indices_;
  float slack_ = 0.0f;
  std::vector<Cluster> clusters_;
  std::vector<Cut> cuts_;
};

}  // namespace octoblisk::detail
