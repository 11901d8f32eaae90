// The winding number of a mesh: what is inside.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/winding_share.h"
#include "octoblisk/clustered_octree.h"

namespace octoblisk::detail {

/// The number of times that a half-line from the point leaves the mesh minus the number of times that it
/// enters it; none on the surface. Without open edges, this is the winding number. `counts` has the number of
/// times that each triangle counts, negative for its other side; empty if each counts once. Exact on the
/// vertices posed in double precision. Allocates nothing.
std::optional<int> crossingNumber(const ClusteredOctree& tree, const Vec3& point, const Pose& tree_in_a = {},
                                  std::span<const signed char> counts = {});

/// The winding number of a mesh with open edges. Caps close the mesh. The winding number of the mesh is that
/// of the closed one, an integer that crossings count exactly, minus the share of directions in which the
/// point sees the caps (C. Martens, M. Bessmeltsev, One-shot method for computing generalized winding
/// numbers, CGF 44 (5), 2025, add up the open edges instead).
class Winding {
 public:
  /// The tree must outlive it. `counts` are those of crossingNumber.
  Winding(const ClusteredOctree& tree, std::vector<std::vector<Triangle>> caps,
          std::vector<signed char> counts = {});

  /// A tree over the caps; null if there are none.
  const ClusteredOctree* capTree() const { return cap_tree_.get(); }

  /// The winding number.
  double valueAt(const Vec3& point) const;
  /// The winding number, rounded; none on the surface. Allocates nothing.
  std::optional<int> at(const Vec3& point, const Pose& tree_in_a = {}) const;
  /// The winding number of the mesh closed by its caps; none on the mesh.
  std::optional<int> closedAt(const Vec3& point, const Pose& tree_in_a = {}) const;

 private:
  const ClusteredOctree* tree_;
  std::vector<signed char> counts_;
  WindingShare caps_;
  std::shared_ptr<const ClusteredOctree> cap_tree_;  // null without caps
};

}  // namespace octoblisk::detail
