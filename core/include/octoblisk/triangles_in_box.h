// The triangles near an oriented box.
#pragma once

#include <cstdint>

#include "octoblisk/clustered_octree.h"

namespace octoblisk {

/// Calls visit(user, triangle) for every triangle within `reach` of a box in the mesh's frame, and for some
/// other triangles nearby. Stops and returns true as soon as a call returns true; otherwise returns false.
bool forEachTriangleIn(const ClusteredOctree& tree, const Obb& box_in_tree, double reach,
                       bool (*visit)(void* user, std::uint32_t triangle), void* user);

/// The same for any callable that takes a triangle's index.
template <typename Visit>
bool forEachTriangleIn(const ClusteredOctree& tree, const Obb& box_in_tree, double reach, Visit&& visit) {
  return forEachTriangleIn(
      tree, box_in_tree, reach,
      [](void* user, std::uint32_t triangle) {
        return (*static_cast<std::remove_reference_t<Visit>*>(user))(triangle);
      },
      &visit);
}

}  // namespace octoblisk
