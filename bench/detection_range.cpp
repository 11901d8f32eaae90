#include "detection_range.h"

#include "build/paper/principal_box.h"

namespace octoblisk::bench {

using namespace detail;

double DetectionRange::axisAlignedVolume() const {
  double volume = 0.0;
  for (const Aabb& box : axis_aligned) volume += (box.max - box.min).prod();
  return volume;
}

double DetectionRange::orientedVolume() const {
  double volume = 0.0;
  for (const Obb& box : oriented) volume += box.volume();
  return volume;
}

DetectionRange detectionRange(const TriangleMesh& mesh, const PartClusterOptions& options) {
  std::vector<Vec3> centroids;
  centroids.reserve(mesh.triangleCount());
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) centroids.push_back(centroidOf(mesh.triangle(t)));
  DetectionRange range;
  for (const std::vector<TriangleSet>& part : partClusters(centroids, options)) {
    for (const TriangleSet& cluster : part) {
      std::vector<Vec3> corners;
      corners.reserve(3 * cluster.size());
      for (const std::uint32_t t : cluster) {
        for (const Vec3& corner : mesh.triangle(t)) corners.push_back(corner);
      }
      range.axis_aligned.push_back(boundsOf(corners));
      range.oriented.push_back(principalBox(corners));
    }
  }
  return range;
}

}  // namespace octoblisk::bench
