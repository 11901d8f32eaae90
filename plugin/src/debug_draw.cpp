#include "octoblisk_bullet/debug_draw.h"

#include <LinearMath/btIDebugDraw.h>

#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk {

void drawClusters(btIDebugDraw& drawer, const btTransform& shape_in_world, const ClusteredOctreeShape& shape,
                  int depth, const btVector3& color) {
  for (const Obb& box : shape.tree().boxes(depth)) {
    const std::array<Vec3, 8> corners = box.corners();
    const auto inWorld = [&](std::size_t corner) { return shape_in_world * toBullet(corners[corner]); };
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t across = corner | std::size_t{1} << axis;
        if (across != corner) drawer.drawLine(inWorld(corner), inWorld(across), color);
      }
    }
  }
}

}  // namespace octoblisk
