// Whether a moving point is inside a solid.
#pragma once

#include <optional>

#include "contact/solid_mesh.h"
#include "octoblisk/function_ref.h"

namespace octoblisk::detail {

/// Whether a moving point is inside a solid: SolidMesh::contains, except within rounding of the surface.
/// Searches the tree only if the point may have crossed the surface since the last call, or if the solid has
/// holes. Allocates nothing.
class PointInSolid {
 public:
  /// The point is in the mesh's frame. Its distance to the surface is at least leastClearance(), which is
  /// called if earlier clearances do not suffice. A number below 0 says nothing.
  bool contains(const SolidMesh& solid, const Vec3& point, FunctionRef<double()> leastClearance);
  bool contains(const SolidMesh& solid, const Vec3& point) {
    return contains(solid, point, [] { return 0.0; });
  }

  /// Call this after the mesh has changed.
  void forget() { *this = {}; }

 private:
  std::optional<Vec3> last_;  // the point of the last call
  bool is_inside_ = false;    // the last point
  double clearance_ = 0.0;    // at most its distance to the surface
};

}  // namespace octoblisk::detail
