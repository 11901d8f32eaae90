#include "octoblisk_bullet/debug_draw.h"

#include <LinearMath/btIDebugDraw.h>

#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk {

using namespace detail;

void drawClusters(btIDebugDraw& drawer, const btTransform& shape_in_world, const ClusteredOctreeShape& shape,
                  int depth, const btVector3& color) {
  constexpr int kCorners = 8;
  for (const Obb& box : shape.tree().boxes(depth)) {
    // Bit k of a corner's number: the side of axis k on which the corner is.
    btVector3 corners[kCorners];
    for (int corner = 0; corner < kCorners; ++corner) {
      const Vec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      corners[corner] =
          shape_in_world * toBullet(box.center + box.axes * box.half_extents.cwiseProduct(side));
    }
    for (int corner = 0; corner < kCorners; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        const int across = corner | 1 << axis;
        if (across != corner) drawer.drawLine(corners[corner], corners[across], color);
      }
    }
  }
}

}  // namespace octoblisk
