// The collision detection range (Table 3 of the paper): the boxes that something must come into before it is
// examined any closer.
#pragma once

#include <vector>

#include "build/paper/part_clusters.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::bench {

/// A box for each cluster, part by part, in the mesh's frame. Each holds the whole triangles of its cluster
/// (erratum 14: a box of points alone would not).
struct DetectionRange {
  std::vector<Aabb> axis_aligned;
  std::vector<Obb>
      oriented;  ///< of the same clusters, in the principal axes of their corners (principal_box.h)

  /// The volumes of the boxes summed, mesh units cubed: what two boxes share counts twice, so the space that
  /// they take is no more than this.
  double axisAlignedVolume() const;
  double orientedVolume() const;
};

/// The boxes of the mesh's parts, each divided into k clusters. With one part and k = 1 the axis-aligned one
/// is the mesh's own. Throws as partClusters does.
DetectionRange detectionRange(const TriangleMesh& mesh, const detail::PartClusterOptions& options = {});

}  // namespace octoblisk::bench
