// The triangles near a convex body.
#pragma once

#include <cstdint>
#include <type_traits>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/convex.h"

namespace octoblisk {

/// Calls visit(user, triangle) for every triangle within `reach` of a convex body, and for some other
/// triangles nearby. Stops and returns true as soon as a call returns true; otherwise returns false.
bool forEachTriangleNear(const ClusteredOctree& tree, const Convex& convex, const Pose& convex_in_tree,
                         double reach, bool (*visit)(void* user, std::uint32_t triangle), void* user);

/// The same for any callable that takes a triangle's index.
template <typename Visit>
bool forEachTriangleNear(const ClusteredOctree& tree, const Convex& convex, const Pose& convex_in_tree,
                         double reach, Visit&& visit) {
  return forEachTriangleNear(
      tree, convex, convex_in_tree, reach,
      [](void* user, std::uint32_t triangle) {
        return (*static_cast<std::remove_reference_t<Visit>*>(user))(triangle);
      },
      &visit);
}

}  // namespace octoblisk
