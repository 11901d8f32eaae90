#include "contact/near_features.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/near_features.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>

#include "base/no_index.h"
#include "query/traversal-inl.h"
#include "simd/triangle8-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// Farther away than any corner: unused lanes are in no box.
constexpr float kUnused = 1e18f;

/// Adds the corners that are listed with a leaf's triangles.
void addCornersOf(const MeshFeatures& mesh, const Pose& in_other, Child leaf,
                  std::vector<LeavesNearby::Corners>& added) {
  std::uint32_t count = 0;
  for (std::uint32_t place = leaf.first(); place < leaf.first() + leaf.count(); ++place) {
    const std::uint32_t triangle = treeOf(mesh.tree()).triangleOrder()[place];
    for (const std::uint32_t v : Lanes(mesh.cornersAt(place))) {
      const std::uint32_t lane = count++ % kLanes;
      if (lane == 0) {
        for (auto& row : added.emplace_back().position) std::ranges::fill(row, kUnused);
      }
      LeavesNearby::Corners& corners = added.back();
      const Vec3 position = in_other * mesh.tree().mesh().triangle(triangle)[v];
      for (int k = 0; k < 3; ++k) corners.position[k][lane] = static_cast<float>(position[k]);
      corners.triangle[lane] = triangle;
      corners.corner[lane] = v;
    }
  }
}

/// Adds the edges of at least some sharpness that are listed with a leaf's triangles.
void addEdgesOf(const MeshFeatures& mesh, const Pose& in_a, Child leaf, float least_sharpness,
                std::vector<LeavesNearby::Edge>& added) {
  for (const SharpEdge& edge : mesh.edgesOfLeaf(leaf.first(), leaf.first() + leaf.count())) {
    if (edge.sharpness < least_sharpness) break;
    const Triangle triangle = mesh.tree().mesh().triangle(edge.triangle);
    const Vec3 &from = triangle[edge.corner], &to = triangle[(edge.corner + 1) % 3];
    const Eigen::Vector3f middle = (in_a * (0.5 * (from + to))).cast<float>();
    added.push_back({&edge, {middle[0], middle[1], middle[2]}, static_cast<float>(0.5 * (to - from).norm())});
  }
}

HWY_INLINE Vec8 unit(const Vec8& v) { return v * (Float8(1.0f) / sqrt(nonzero(dot(v, v)))); }

/// The frame of a leaf's box in the tree's local frame.
struct LeafFrame {
  float axes[3][3], center[3], half_extents[3];

  LeafFrame(const Tree& tree, Slot slot) {
    Box8 room(Box8::Unset{});
    const Box8& box = boxesAt(tree, slot, room);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) axes[i][k] = box.axes[k][i][slot.lane];
      center[i] = box.center[i][slot.lane];
      half_extents[i] = box.half_extents[i][slot.lane];
    }
  }

  /// Planes through points, perpendicular to unit vectors; both in this frame.
  HWY_INLINE LeavesNearby::Planes planes(const Vec8& normal, const Vec8& through) const {
    LeavesNearby::Planes planes;
    Float8 height = dot(normal, through);
    for (int k = 0; k < 3; ++k) {
      const Float8 component =
          Float8(axes[0][k]) * normal.x + Float8(axes[1][k]) * normal.y + Float8(axes[2][k]) * normal.z;
      height = height + component * Float8(center[k]);
      component.store(planes.normal[k]);
    }
    height.store(planes.height);
    return planes;
  }
};

/// A mesh, its poses in the other tree's local frame and in A's, and what is sought of it.
struct Searched {
  const MeshFeatures& mesh;
  Pose in_other, in_a;
  float reach, least_sharpness;
  LeavesNearby& nearby;
};

void addLeaf(const Searched& searched, Slot slot) {
  const auto& [mesh, in_other, in_a, reach, least_sharpness, nearby] = searched;
  const Tree& tree = treeOf(mesh.tree());
  const Child child = tree.child(slot);
  LeavesNearby::Leaf& leaf = nearby.leaves.emplace_back();
  leaf.slot = slot.node * kLanes + slot.lane;
  leaf.corners_begin = static_cast<std::uint32_t>(nearby.corners.size());
  addCornersOf(mesh, in_other, child, nearby.corners);
  leaf.corners_end = static_cast<std::uint32_t>(nearby.corners.size());
  leaf.edges_begin = static_cast<std::uint32_t>(nearby.edges.size());
  addEdgesOf(mesh, in_a, child, least_sharpness, nearby.edges);
  leaf.edges_end = static_cast<std::uint32_t>(nearby.edges.size());

  LeafVertices room;
  const float* const rows = tree.leafVertices(slot, room);
  Vec8 corners[3];
  for (std::uint32_t v = 0; v < 3; ++v) corners[v] = Vec8::load(rows + 3 * v * child.count(), child.count());
  const LeafFrame frame(tree, slot);
  const Vec8 normal = unit(cross(corners[1] - corners[0], corners[2] - corners[0]));
  leaf.faces = frame.planes(normal, corners[0]);
  for (int v = 0; v < 3; ++v)
    leaf.edges[v] = frame.planes(unit(cross(corners[(v + 1) % 3] - corners[v], normal)), corners[v]);

  const Float8* const components[3] = {&normal.x, &normal.y, &normal.z};
  for (int i = 0; i < 3; ++i) {
    float leans[kLanes];
    abs(*components[i]).store(leans);
    const float most = *std::max_element(leans, leans + child.count());
    // Beside a corner of a triangle, a point may be farther away than beside an edge.
    const float grown = reach * (most + 2.0f * static_cast<float>(kAlike));
    std::ranges::copy(frame.axes[i], leaf.axes[i]);
    leaf.center[i] = frame.axes[i][0] * frame.center[0] + frame.axes[i][1] * frame.center[1] +
                     frame.axes[i][2] * frame.center[2];
    leaf.half_extents[i] = frame.half_extents[i] + grown;
  }
}

/// The place of a slot's leaf.
HWY_INLINE std::uint32_t placeOf(const Searched& searched, Slot slot) {
  std::uint32_t& place = searched.nearby.place[slot.node * kLanes + slot.lane];
  if (place == kNoIndex) {
    place = static_cast<std::uint32_t>(searched.nearby.leaves.size());
    addLeaf(searched, slot);
  }
  return place;
}

/// The corners that are in the box of points over or under a leaf's faces.
HWY_INLINE unsigned cornersInBox(const LeavesNearby::Corners& corners, const LeavesNearby::Leaf& faces,
                                 float rounding) {
  const Vec8 position = Vec8::load(corners.position[0], kLanes);
  unsigned outside = 0;
  for (int i = 0; i < 3; ++i) {
    const Float8 along = dot(Vec8::all(faces.axes[i]), position) - Float8(faces.center[i]);
    outside |= less(Float8(faces.half_extents[i] + rounding), abs(along));
  }
  return kAllLanes & ~outside;
}

HWY_INLINE Float8 heightsOver(const LeavesNearby::Planes& planes, const Vec8& point) {
  return dot(Vec8::load(planes.normal[0], kLanes), point) - Float8::load(planes.height);
}

/// The faces of a leaf, of the first `lanes`, over or under which a point is.
HWY_INLINE unsigned facesUnder(const LeavesNearby::Leaf& leaf, unsigned lanes, const Vec8& point, float reach,
                               float rounding) {
  const Float8 height = abs(heightsOver(leaf.faces, point));
  const unsigned near = lanes & ~less(Float8(reach), height);
  if (near == 0) return 0;
  const Float8 slack = height * Float8(static_cast<float>(kAlike)) + Float8(rounding);
  const Float8 beside = max(heightsOver(leaf.edges[0], point),
                            max(heightsOver(leaf.edges[1], point), heightsOver(leaf.edges[2], point)));
  return near & ~less(slack, beside);
}

/// Whether a direction of B's cone may be opposite to one of A's.
HWY_INLINE bool mayOppose(const NormalCone& of_a, const NormalCone& of_b, const Eigen::Matrix3f& b_to_a) {
  const float sine = of_a.sine * of_b.cosine + of_a.cosine * of_b.sine,
              cosine = of_a.cosine * of_b.cosine - of_a.sine * of_b.sine;  // of the sum of both angles
  return sine <= 0.0f || -of_a.axis.dot(b_to_a * of_b.axis) >= cosine;
}

void addNearFeatures(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a, double reach,
                     float least_sharpness, LeavesNearby& of_a, LeavesNearby& of_b, NearFeatures& near) {
  const Tree &tree_a = treeOf(a.tree()), &tree_b = treeOf(b.tree());
  const LocalPose pose(tree_a, tree_b, b_in_a);
  const float limit = pose.limit(reach), rounding = pose.limit(0.0);
  const Pose a_local{Mat3::Identity(), -tree_a.origin()};
  const Pose b_to_a{b_in_a.rotation, b_in_a.translation - tree_a.origin()};
  Pose a_to_b = b_in_a.inverse();
  a_to_b.translation -= tree_b.origin();
  const Searched searched_a{a, a_to_b, a_local, limit, least_sharpness, of_a},
      searched_b{b, b_to_a, b_to_a, limit, least_sharpness, of_b};
  const Eigen::Matrix3f turn = b_in_a.rotation.cast<float>();
  const auto addPairs = [&](const LeavesNearby& own, const LeavesNearby::Leaf& leaf,
                            const LeavesNearby::Leaf& faces, std::span<const std::uint32_t> triangles,
                            std::vector<CornerAndFace>& found) HWY_ATTR {
    const unsigned lanes = (1u << triangles.size()) - 1u;
    for (std::uint32_t c = leaf.corners_begin; c < leaf.corners_end; ++c) {
      const LeavesNearby::Corners& corners = own.corners[c];
      const auto& [x, y, z] = corners.position;
      for (const std::uint32_t lane : Lanes(cornersInBox(corners, faces, rounding))) {
        const Vec8 point{Float8(x[lane]), Float8(y[lane]), Float8(z[lane])};
        for (const std::uint32_t face : Lanes(facesUnder(faces, lanes, point, limit, rounding)))
          found.push_back({corners.triangle[lane], corners.corner[lane], triangles[face]});
      }
    }
  };
  const auto visit = [&](Slot slot_a, Slot slot_b) HWY_ATTR {
    const std::uint32_t place_a = placeOf(searched_a, slot_a), place_b = placeOf(searched_b, slot_b);
    const LeavesNearby::Leaf &leaf_a = of_a.leaves[place_a], &leaf_b = of_b.leaves[place_b];
    const Child child_a = tree_a.child(slot_a), child_b = tree_b.child(slot_b);
    const LeafCones &cones_a = a.conesAt(slot_a), &cones_b = b.conesAt(slot_b);
    if (mayOppose(cones_a.corners, cones_b.faces, turn))
      addPairs(of_a, leaf_a, leaf_b, tree_b.triangles(child_b), near.corners_of_a);
    if (mayOppose(cones_a.faces, cones_b.corners, turn))
      addPairs(of_b, leaf_b, leaf_a, tree_a.triangles(child_a), near.corners_of_b);
    for (std::uint32_t i = leaf_a.edges_begin; i < leaf_a.edges_end; ++i) {
      for (std::uint32_t j = leaf_b.edges_begin; j < leaf_b.edges_end; ++j) {
        const LeavesNearby::Edge &edge_a = of_a.edges[i], &edge_b = of_b.edges[j];
        const float x = edge_a.middle[0] - edge_b.middle[0], y = edge_a.middle[1] - edge_b.middle[1],
                    z = edge_a.middle[2] - edge_b.middle[2], far = edge_a.radius + edge_b.radius + limit;
        if (x * x + y * y + z * z <= far * far) near.edges.push_back({edge_a.edge, edge_b.edge});
      }
    }
    return false;
  };
  walkPairs<TraversalStack>(
      tree_a, tree_b, pose, NodePair(), WidestGap(), [&] { return limit; }, visit);
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk::detail {

namespace {
HWY_EXPORT(addNearFeatures);
}

void NearFeatures::find(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a, double reach,
                        float least_sharpness) {
  corners_of_a.clear();
  corners_of_b.clear();
  edges.clear();
  const auto prepare = [](LeavesNearby& nearby, const MeshFeatures& mesh) {
    for (const LeavesNearby::Leaf& leaf : nearby.leaves) nearby.place[leaf.slot] = kNoIndex;
    nearby.leaves.clear();
    nearby.corners.clear();
    nearby.edges.clear();
    const std::size_t slots = treeOf(mesh.tree()).nodeCount() * kLanes;
    if (nearby.place.size() < slots) nearby.place.resize(slots, kNoIndex);
  };
  prepare(of_a_, a);
  prepare(of_b_, b);
  HWY_DYNAMIC_DISPATCH(addNearFeatures)(a, b, b_in_a, reach, least_sharpness, of_a_, of_b_, *this);
}

}  // namespace octoblisk::detail
#endif
