#include "contact/mesh_features.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/no_index.h"
#include "simd/lanes.h"
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
  return {axis.cast<float>(), static_cast<float>(std::cos(angle))};
}

/// A direction may push a corner if it leans no more than the faces around the corner, and kAlike more. This
/// angle, in radians, is wide enough for both cones of a pair.
constexpr double kLean = 0.25;

/// The angle of a triangle at a corner.
double angleAt(const Triangle& triangle, std::size_t v) {
  const Vec3 first = triangle[(v + 1) % 3] - triangle[v], second = triangle[(v + 2) % 3] - triangle[v];
  return std::atan2(first.cross(second).norm(), first.dot(second));
}

}  // namespace

MeshFeatures::MeshFeatures(const SolidMesh& solid) : solid_(solid), has_sheets_(!solid.boundsEverywhere()) {
  const Surface surface(tree(), Surface::OnlyConnected());
  leaves_.resize(treeOf(tree()).nodeCount() * kLanes);
  listCorners(surface);
  listEdges(surface);
  describeLeaves(surface);
  findReaches();
}

void MeshFeatures::listCorners(const Surface& surface) {
  const auto& order = treeOf(tree()).triangleOrder();
  const auto& triangles = tree().mesh().triangles();
  std::vector<std::uint32_t> number(surface.cornerCount(), kNoIndex), listed;  // corners of the surface
  vertex_.reserve(surface.cornerCount());
  triangle_.reserve(surface.cornerCount());
  listed.reserve(surface.cornerCount());
  corner_.assign(tree().mesh().vertices().size(), kNoIndex);
  corners_at_.assign(order.size(), 0);
  for (std::uint32_t place = 0; place < order.size(); ++place) {
    for (std::uint32_t v = 0; v < 3; ++v) {
      const std::uint32_t corner = surface.corners(order[place])[v], vertex = triangles[order[place]][v];
      if (number[corner] == kNoIndex) {
        number[corner] = static_cast<std::uint32_t>(vertex_.size());
        vertex_.push_back(vertex);
        triangle_.push_back(order[place]);
        listed.push_back(corner);
        corners_at_[place] |= static_cast<std::uint8_t>(1u << v);
      }
      corner_[vertex] = number[corner];
    }
  }
  normals_.reserve(listed.size());
  neighbours_begin_.reserve(listed.size() + 1);
  for (const std::uint32_t corner : listed) gatherNeighbours(surface, corner);
  neighbours_begin_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
  neighbours_.shrink_to_fit();
}

void MeshFeatures::gatherNeighbours(const Surface& surface, std::uint32_t corner_of_surface) {
  const auto begin = static_cast<std::ptrdiff_t>(neighbours_.size());
  neighbours_begin_.push_back(static_cast<std::uint32_t>(begin));
  Vec3 normal = Vec3::Zero();  // weighted by angles (Bærentzen and Aanæs 2005)
  double angles = 0.0;
  bool is_of_sheet = false;
  for (const std::uint32_t triangle : surface.star(corner_of_surface)) {
    is_of_sheet |= isSheet(triangle);
    const auto& corners = surface.corners(triangle);
    const auto v = static_cast<std::size_t>(std::ranges::find(corners, corner_of_surface) - corners.begin());
    const Triangle positions = tree().mesh().triangle(triangle);
    const double angle = angleAt(positions, v);
    normal += angle * unitNormal(positions);
    angles += angle;
    for (const std::size_t other : {(v + 1) % 3, (v + 2) % 3}) {
      const std::uint32_t neighbour = cornersOf(triangle)[other];
      if (corners[other] == corner_of_surface) continue;
      if (std::find(neighbours_.begin() + begin, neighbours_.end(), neighbour) != neighbours_.end()) continue;
      neighbours_.push_back(neighbour);
    }
  }
  if (is_of_sheet) normal.setZero();
  normals_.push_back((angles > 0.0 ? Vec3(normal / angles) : normal).cast<float>());
}

void MeshFeatures::listEdges(const Surface& surface) {
  const Tree& tree = treeOf(solid_.boundary());
  const TriangleMesh& mesh = tree.mesh();
  forEachChild(tree.arrays(), [&](Slot slot, Child child) {
    if (!child.isLeaf()) return;
    LeafFeatures& leaf = leaves_[slot.node * kLanes + slot.lane];
    leaf.edges_begin = static_cast<std::uint32_t>(edges_.size());
    for (std::uint32_t place = child.first(); place < child.first() + child.count(); ++place) {
      const std::uint32_t triangle = tree.triangleOrder()[place];
      const Vec3 normal = scaledNormal(mesh.triangle(triangle));
      for (std::uint32_t v = 0; v < 3; ++v) {
        const std::uint32_t across = triangleAcross(surface, triangle, v);
        if (across != kNoTriangle ? across < triangle : !isSheet(triangle)) continue;
        const Vec3 along = mesh.triangle(triangle)[(v + 1) % 3] - mesh.triangle(triangle)[v];
        const Vec3 other = across != kNoTriangle ? scaledNormal(mesh.triangle(across)) : Vec3(-normal);
        const double turn = std::atan2(normal.cross(other).norm(), normal.dot(other)),
                     convexity = normal.cross(other).dot(along);
        if (across != kNoTriangle &&
            !(isSheet(triangle) && isSheet(across) ? convexity != 0.0 : convexity > 0.0))
          continue;
        edges_.push_back({place, v, across, static_cast<float>(along.norm() * turn / 8.0)});
      }
    }
    leaf.edges_end = static_cast<std::uint32_t>(edges_.size());
    std::stable_sort(edges_.begin() + leaf.edges_begin, edges_.end(),
                     [](const SharpEdge& a, const SharpEdge& b) { return a.sharpness > b.sharpness; });
  });
  edges_.shrink_to_fit();
}

void MeshFeatures::describeLeaves(const Surface& surface) {
  const Tree& tree = treeOf(solid_.boundary());
  std::vector<Vec3> normals;
  forEachChild(tree.arrays(), [&](Slot slot, Child child) {
    if (!child.isLeaf()) return;
    LeafFeatures& leaf = leaves_[slot.node * kLanes + slot.lane];
    leaf.corners_begin = static_cast<std::uint32_t>(vertex_.size());
    normals.clear();
    for (std::uint32_t place = child.first(); place < child.first() + child.count(); ++place) {
      const std::uint32_t triangle = tree.triangleOrder()[place];
      for (const std::uint32_t v : Lanes(cornersAt(place))) {
        leaf.corners_begin = std::min(leaf.corners_begin, cornersOf(triangle)[v]);
        for (const std::uint32_t around : surface.star(surface.corners(triangle)[v]))
          normals.push_back(unitNormal(tree.mesh().triangle(around)));
      }
    }
    if (!hasSheets()) leaf.against = coneAround(normals, kLean);
  });
}

void MeshFeatures::findReaches() {
  const Tree& tree = treeOf(solid_.boundary());
  struct Box {
    Slot slot;
    Mat3 axes;
  };
  std::vector<Box> above;  // the boxes from the root down to the current leaf
  reaches_.assign(tree.nodeCount(), {});
  const auto visit = [&](const auto& self, Slot slot) -> void {
    const Child child = tree.child(slot);
    if (child.isEmpty()) return;
    above.push_back({slot, tree.box(slot).axes});
    if (!child.isLeaf()) {
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) self(self, {child.node(), lane});
    } else {
      for (std::uint32_t place = child.first(); place < child.first() + child.count(); ++place) {
        const Vec3 normal = unitNormal(tree.mesh().triangle(tree.triangleOrder()[place]));
        for (const Box& box : above) {
          for (int i = 0; i < 3; ++i) {
            float& lean = reaches_[box.slot.node].lean[i][box.slot.lane];
            lean = std::max(lean, static_cast<float>(std::abs(box.axes.col(i).dot(normal))));
          }
        }
      }
      for (const SharpEdge& edge : edgesOf(of(slot))) {
        for (const Box& box : above) {
          float& sharpness = reaches_[box.slot.node].sharpness[box.slot.lane];
          sharpness = std::max(sharpness, edge.sharpness);
        }
      }
    }
    above.pop_back();
  };
  visit(visit, Tree::kRoot);
}

std::uint32_t MeshFeatures::triangleOf(const SharpEdge& edge) const {
  return treeOf(tree()).triangleOrder()[edge.place];
}

bool MeshFeatures::isPushedAlong(std::uint32_t corner, const Vec3& direction) const {
  if (direction.dot(normals_[corner].cast<double>()) > kAlike) return false;
  const Vec3& from = position(corner);
  return std::ranges::all_of(neighboursOf(corner), [&](std::uint32_t neighbour) {
    const Vec3 way = position(neighbour) - from;
    const double along = direction.dot(way);
    return along >= 0.0 || along * along <= kAlike * kAlike * way.squaredNorm();
  });
}

std::uint32_t MeshFeatures::neighbourAgainst(std::uint32_t corner, const Vec3& direction) const {
  const auto along = [&](std::uint32_t c) { return direction.dot(position(c)); };
  const auto neighbours = neighboursOf(corner);
  const auto next = std::ranges::min_element(neighbours, {}, along);
  return next != neighbours.end() && along(*next) < along(corner) ? *next : kNoIndex;
}

}  // namespace octoblisk::detail
