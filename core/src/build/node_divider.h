// Divides one node of the tree into clusters.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "build/box_fit.h"
#include "build/split_finder.h"

namespace octoblisk::detail {

/// A cluster: a range of the divided indices.
struct Cluster {
  std::uint32_t begin, end;
  BoxF box;            ///< its frame is final; its extents are approximate unless exact
  bool exact = false;  ///< whether the box contains all vertices

  std::uint32_t count() const { return end - begin; }
};

/// A cluster was divided by a plane: it became its low side, and the clusters after it moved by one to make
/// room for its high side.
struct Cut {
  std::size_t cluster;
  SplitFinder::Plane plane;
};

/// Divides the triangles of a node, widest cluster first, until there are eight clusters, or no cluster
/// exceeds `capacity` or the size of a node that consists of leaves only. Reuses its memory between nodes.
class NodeDivider {
 public:
  NodeDivider(std::uint32_t capacity, const SplitEffort& effort) : capacity_(capacity), effort_(effort) {}

  /// The clusters of the records that the indices refer to; sorts the indices by cluster. The next call
  /// overwrites the result.
  const std::vector<Cluster>& byClusters(std::span<const TriangleRecord> records,
                                         std::span<std::uint32_t> indices, const BoxF& box);

  /// The same by medians only: for nodes too deep for clusters, which may be unbalanced.
  const std::vector<Cluster>& byMedians(std::span<const TriangleRecord> records,
                                        std::span<std::uint32_t> indices, const BoxF& box);

  /// The same for a sample, by planes only, which can then divide other records. Returns one cluster if there
  /// is no plane.
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
