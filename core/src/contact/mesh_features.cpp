#include "contact/mesh_features.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tree/tree.h"

namespace octoblisk::detail {
namespace {

/// The triangle across an edge; kNoTriangle unless exactly two triangles share the edge in opposite
/// directions.
std::uint32_t triangleAcross(const Surface& surface, std::uint32_t triangle, std::uint32_t corner) {
  const auto& corners = surface.corners(triangle);
  const std::uint32_t from = corners[corner], to = corners[(corner + 1) % 3];
  std::uint32_t across = kNoTriangle;
  const bool is_from_smaller = surface.star(from).size() <= surface.star(to).size();
  for (const std::uint32_t other : surface.star(is_from_smaller ? from : to)) {
    if (other == triangle) continue;
    const auto& of_other = surface.corners(other);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t first = of_other[k], second = of_other[(k + 1) % 3];
      if (first == from && second == to) return kNoTriangle;
      if (first != to || second != from) continue;
      if (across != kNoTriangle) return kNoTriangle;
      across = other;
    }
  }
  return across;
}

/// The cone around normals, wider by an angle.
NormalCone coneAround(std::span<const Vec3> normals, double wider) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& normal : normals) sum += normal;
  if (sum.isZero(0.0)) return {};
  const Vec3 axis = sum.normalized();
  double least = 1.0;
  for (const Vec3& normal : normals) {
    if (!normal.isZero(0.0)) least = std::min(least, axis.dot(normal));
  }
  const double rounding = 1e-5, angle = std::acos(std::clamp(least, -1.0, 1.0)) + wider + rounding;
  if (angle >= std::numbers::pi) return {};
  return {axis.cast<float>(), static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

/// A direction may push a corner if it leans no more than the faces around the corner, and kAlike more. This
/// angle, in radians, is wide enough for both cones of a pair.
constexpr double kLean = 0.25;

}  // namespace

MeshFeatures::MeshFeatures(const ClusteredOctree& octree) : surface_(octree, Surface::OnlyConnected()) {
  const Tree& tree = treeOf(octree);
  const TriangleMesh& mesh = octree.mesh();
  const std::size_t count = mesh.triangleCount();
  corners_at_.assign(count, 0);
  edge_begin_.assign(count + 1, 0);
  std::vector<bool> is_listed(surface_.cornerCount(), false);
  for (std::uint32_t place = 0; place < count; ++place) {
    const std::uint32_t triangle = tree.triangleOrder()[place];
    edge_begin_[place] = static_cast<std::uint32_t>(edges_.size());
    const Vec3 normal = scaledNormal(mesh.triangle(triangle));
    for (std::uint32_t v = 0; v < 3; ++v) {
      const std::uint32_t corner = surface_.corners(triangle)[v];
      if (!is_listed[corner]) corners_at_[place] |= static_cast<std::uint8_t>(1u << v);
      is_listed[corner] = true;
      const std::uint32_t across = triangleAcross(surface_, triangle, v);
      if (across == kNoTriangle || across < triangle) continue;
      const Vec3 other = scaledNormal(mesh.triangle(across));
      const Vec3 along = mesh.triangle(triangle)[(v + 1) % 3] - mesh.triangle(triangle)[v];
      const double turn = std::atan2(normal.cross(other).norm(), normal.dot(other));
      if (!(normal.cross(other).dot(along) > 0.0)) continue;
      edges_.push_back({triangle, v, across, static_cast<float>(along.norm() * turn / 8.0)});
    }
  }
  edge_begin_[count] = static_cast<std::uint32_t>(edges_.size());
  edges_.shrink_to_fit();
  cones_.resize(tree.nodeCount() * kLanes);
  for (std::uint32_t node = 0; node < tree.nodeCount(); ++node) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Child child = tree.child({node, lane});
      if (child.isEmpty() || !child.isLeaf()) continue;
      cones_[node * kLanes + lane] = conesOf(child.first(), child.first() + child.count());
      const auto of_leaf = [&](std::uint32_t place) { return edges_.begin() + edge_begin_[place]; };
      std::stable_sort(of_leaf(child.first()), of_leaf(child.first() + child.count()),
                       [](const SharpEdge& a, const SharpEdge& b) { return a.sharpness > b.sharpness; });
    }
  }
}

LeafCones MeshFeatures::conesOf(std::uint32_t first, std::uint32_t end) const {
  const TriangleMesh& mesh = tree().mesh();
  const auto& order = treeOf(tree()).triangleOrder();
  std::vector<Vec3> of_faces, of_corners;
  for (std::uint32_t place = first; place < end; ++place) {
    const std::uint32_t triangle = order[place];
    of_faces.push_back(unitNormal(mesh.triangle(triangle)));
    for (std::uint32_t v = 0; v < 3; ++v) {
      if ((cornersAt(place) >> v & 1u) == 0) continue;
      for (const std::uint32_t around : surface_.star(surface_.corners(triangle)[v]))
        of_corners.push_back(unitNormal(mesh.triangle(around)));
    }
  }
  return {coneAround(of_faces, 0.0), coneAround(of_corners, kLean)};
}

bool MeshFeatures::isPushedAlong(std::uint32_t corner, const Vec3& direction) const {
  const Vec3& position = surface_.position(corner);
  bool faces_push = false;
  for (const std::uint32_t triangle : surface_.star(corner)) {
    const auto& corners = surface_.corners(triangle);
    const std::size_t v = corners[0] == corner ? 0 : corners[1] == corner ? 1 : 2;
    const Vec3 ways[2] = {surface_.position(corners[(v + 1) % 3]) - position,
                          surface_.position(corners[(v + 2) % 3]) - position};
    for (const Vec3& way : ways) {
      const double height = direction.dot(way);
      if (height < 0.0 && height * height > kAlike * kAlike * way.squaredNorm()) return false;
    }
    faces_push |= direction.dot(ways[0].cross(ways[1])) < 0.0;
  }
  return faces_push;
}

}  // namespace octoblisk::detail
