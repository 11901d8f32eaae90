// The collision detection range (Table 3 of the paper): an object is examined closely only if it enters these
// boxes.
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
      oriented;  ///< around the same clusters, in the principal axes of their corners (principal_box.h)

  /// The sum of the boxes' volumes, in mesh units cubed. It counts overlaps twice, so it is an upper bound of
  /// the space that the boxes take.
  double axisAlignedVolume() const;
  double orientedVolume() const;
};

/// The boxes of the mesh's parts. Each part is divided into k clusters. With one part and k = 1, the
/// axis-aligned box is that of the mesh. Throws what partClusters throws.
DetectionRange detectionRange(const TriangleMesh& mesh, const detail::PartClusterOptions& options = {});

}  // namespace octoblisk::bench
