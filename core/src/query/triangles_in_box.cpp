#include "octoblisk/triangles_in_box.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/triangles_in_box.cpp"
#include <hwy/foreach_target.h>

#include "query/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

bool trianglesIn(const Tree& tree, const Obb& box_in_tree, double reach,
                 FunctionRef<bool(std::uint32_t triangle)> visit) {
  const LocalBox local(tree, box_in_tree);
  return forEachLeafWithin(tree, local, WidestGap(), local.limit(reach), [&](Slot leaf) {
    for (const std::uint32_t triangle : tree.triangles(tree.child(leaf))) {
      if (visit(triangle)) return true;
    }
    return false;
  });
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk {

using namespace detail;

HWY_EXPORT(trianglesIn);

bool forEachTriangleIn(const ClusteredOctree& tree, const Obb& box_in_tree, double reach,
                       FunctionRef<bool(std::uint32_t triangle)> visit) {
  return HWY_DYNAMIC_DISPATCH(trianglesIn)(treeOf(tree), box_in_tree, reach, visit);
}

}  // namespace octoblisk
#endif
