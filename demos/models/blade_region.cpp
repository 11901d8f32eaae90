#include "models/blade_region.h"

#include <algorithm>
#include <string>
#include <utility>

#include "models/require.h"

namespace octoblisk::demos {
namespace {

/// From the edge outwards.
std::vector<ContourPoint> besideEdge(std::vector<ContourPoint> side, BladeRegion edge, double reach) {
  if (edge == BladeRegion::trailing_edge) std::reverse(side.begin(), side.end());
  const ContourLine whole(std::move(side));
  require(reach <= whole.length(),
          "--edge-reach is too large for the side, which is " + std::to_string(whole.length()) + " mm wide");
  return whole.cut(0.0, reach).points();
}

}  // namespace

ContourLine regionLine(const BladeContour& contour, BladeRegion region, double edge_reach) {
  if (region == BladeRegion::forward) return ContourLine(contour.forward);
  if (region == BladeRegion::backward) return ContourLine(contour.backward);
  std::vector<ContourPoint> points = besideEdge(contour.backward, region, edge_reach);
  std::reverse(points.begin(), points.end());
  const std::vector<ContourPoint> forward = besideEdge(contour.forward, region, edge_reach);
  points.insert(points.end(), forward.begin() + 1, forward.end());
  return ContourLine(std::move(points));
}

}  // namespace octoblisk::demos
