#include "contact/solid_mesh.h"

#include <algorithm>
#include <ranges>

#include "octoblisk/closest_point.h"
#include "octoblisk/containment.h"
#include "query/solid_parts.h"

namespace octoblisk::detail {

bool SolidMesh::boundsSolid(std::uint32_t triangle) const {
  if (is_sheet_ || !surface_) return !is_sheet_;
  const std::uint32_t source = surface_->sourceOf(triangle);
  const std::vector<char>& near_hole = surface_->solidParts().near_hole;
  return surface_->role(source) == TriangleRole::outward && (near_hole.empty() || near_hole[source] == 0);
}

bool SolidMesh::boundsAnywhere() const {
  const auto triangles = std::views::iota(std::size_t(0), boundary_->mesh().triangleCount());
  return std::ranges::any_of(triangles,
                             [&](std::size_t t) { return boundsSolid(static_cast<std::uint32_t>(t)); });
}

bool SolidMesh::boundsEverywhere() const {
  const auto triangles = std::views::iota(std::size_t(0), boundary_->mesh().triangleCount());
  return std::ranges::all_of(triangles,
                             [&](std::size_t t) { return boundsSolid(static_cast<std::uint32_t>(t)); });
}

bool SolidMesh::contains(const Vec3& point_in_a, const Pose& mesh_in_a) const {
  const Aabb& mesh_bounds = boundary_->mesh().bounds();
  const Vec3 point = mesh_in_a.inverse() * point_in_a;
  if (is_sheet_ || !mesh_bounds.meets({point, point})) return false;
  // Usually, the shortest way out of the bounds meets the fewest boxes.
  Eigen::Index axis_down, axis_up;
  const double down = (point - mesh_bounds.min).minCoeff(&axis_down),
               up = (mesh_bounds.max - point).minCoeff(&axis_up);
  Vec3 out = Vec3::Zero();
  if (down < up) {
    out[axis_down] = -1.0;
  } else {
    out[axis_up] = 1.0;
  }
  Eigen::Index axis;
  const Vec3 out_in_a = mesh_in_a.rotation * out;
  out_in_a.cwiseAbs().maxCoeff(&axis);
  const double sense = out_in_a[axis] < 0.0 ? -1.0 : 1.0;
  Pose turn{Mat3::Zero(), Vec3::Zero()};  // by right angles, so without rounding; the way out becomes +x
  turn.rotation(0, axis) = turn.rotation(1, (axis + 1) % 3) = sense;
  turn.rotation(2, (axis + 2) % 3) = 1.0;
  const Pose turned = turn * mesh_in_a;
  if (!surface_) return crossingNumber(*boundary_, turn * point_in_a, turned).value_or(0) != 0;
  if (locate(*surface_, turn * point_in_a, turned) != PointLocation::inside) return false;
  return surface_->isClosed() || boundsSolid(closestPoint(*boundary_, point)->triangle);
}

}  // namespace octoblisk::detail
