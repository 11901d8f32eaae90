#include "contact/near_features.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/near_features.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>

#include "base/no_index.h"
#include "geometry/triangle_pair.h"
#include "query/collide_walk-inl.h"
#include "simd/triangle8-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// Farther away than any corner: unused lanes are in no box.
constexpr float kUnused = 1e18f;

HWY_INLINE Vec8 unit(const Vec8& v) { return v * (Float8(1.0f) / sqrt(nonzero(dot(v, v)))); }

/// The frame of a leaf's box, in some frame.
struct LeafFrame {
  float axes[3][3];  ///< [axis][component]
  float center[3];

  LeafFrame(const Box8& boxes, std::uint32_t lane) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) axes[i][k] = boxes.axes[k][i][lane];
      center[i] = boxes.center[i][lane];
    }
  }

  explicit LeafFrame(const BoxF& box) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) axes[i][k] = box.axes(k, i);
      center[i] = box.center[i];
    }
  }

  HWY_INLINE Vec8 posed(const Vec8& v) const {
    const auto component = [&](int k) HWY_ATTR {
      return Float8(axes[0][k]) * v.x + Float8(axes[1][k]) * v.y + Float8(axes[2][k]) * v.z +
             Float8(center[k]);
    };
    return {component(0), component(1), component(2)};
  }
};

/// Planes through points, perpendicular to unit vectors.
HWY_INLINE LeavesNearby::Planes planesThrough(const Vec8& points, const Vec8& normals) {
  LeavesNearby::Planes planes;
  normals.x.store(planes.normal[0]);
  normals.y.store(planes.normal[1]);
  normals.z.store(planes.normal[2]);
  dot(normals, points).store(planes.height);
  return planes;
}

/// Eight points, one by one.
struct Points {
  float rows[3][kLanes];

  HWY_INLINE explicit Points(const Vec8& points) {
    points.x.store(rows[0]);
    points.y.store(rows[1]);
    points.z.store(rows[2]);
  }
};

/// A mesh, its poses in the other tree's local frame and in A's, and what is sought of it.
struct Searched {
  const MeshFeatures& mesh;
  PoseF in_other, in_a;
  float reach, least_sharpness;
  LeavesNearby& nearby;
};

/// Adds the corners that are listed with a leaf's triangles.
HWY_INLINE void addCornersOf(const Searched& searched, Child leaf, std::uint32_t first_corner,
                             const Points (&vertices)[3]) {
  const auto triangles = treeOf(searched.mesh.tree()).triangles(leaf);
  std::vector<LeavesNearby::Corners>& added = searched.nearby.corners;
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < leaf.count(); ++i) {
    for (const std::uint32_t v : Lanes(searched.mesh.cornersAt(leaf.first() + i))) {
      const std::uint32_t lane = count % kLanes;
      if (lane == 0) {
        for (auto& row : added.emplace_back().position) std::ranges::fill(row, kUnused);
      }
      LeavesNearby::Corners& corners = added.back();
      for (int k = 0; k < 3; ++k) corners.position[k][lane] = vertices[v].rows[k][i];
      corners.corner[lane] = first_corner + count++;
      corners.triangle[lane] = triangles[i];
    }
  }
}

/// Adds the edges of at least some sharpness that are listed with a leaf's triangles.
HWY_INLINE void addEdgesOf(const Searched& searched, Child leaf, std::span<const SharpEdge> edges,
                           const Vec8 (&vertices)[3], const LeafFrame& in_a) {
  if (edges.empty() || edges[0].sharpness < searched.least_sharpness) return;
  const Points points[3] = {Points(in_a.posed(vertices[0])), Points(in_a.posed(vertices[1])),
                            Points(in_a.posed(vertices[2]))};
  for (const SharpEdge& edge : edges) {
    if (edge.sharpness < searched.least_sharpness) break;
    const std::uint32_t i = edge.place - leaf.first();
    const auto &from = points[edge.corner].rows, &to = points[(edge.corner + 1) % 3].rows;
    LeavesNearby::Edge& added = searched.nearby.edges.emplace_back();
    added.edge = &edge;
    float squared = 0.0f;
    for (int k = 0; k < 3; ++k) {
      const float half = 0.5f * (to[k][i] - from[k][i]);
      added.middle[k] = from[k][i] + half;
      squared += half * half;
    }
    added.radius = std::sqrt(squared);
  }
}

/// How far beside a box a point may be that is over or under a face in it, as a multiple of the point's
/// height; for one box or eight. Beside a corner of a triangle, it may be farther away than beside an edge.
template <typename Real>
HWY_INLINE Real leaning(const Real& lean) {
  return lean + Real(2.0f * static_cast<float>(kAlike));
}

void addLeaf(const Searched& searched, Slot slot) {
  const auto& [mesh, in_other, in_a, reach, least_sharpness, nearby] = searched;
  const Tree& tree = treeOf(mesh.tree());
  const Child child = tree.child(slot);
  Box8 room(Box8::Unset{});
  const Box8& boxes = boxesAt(tree, slot, room);
  LeafVertices vertex_room;
  const float* const rows = tree.leafVertices(slot, vertex_room);
  Vec8 vertices[3];
  for (std::uint32_t v = 0; v < 3; ++v) vertices[v] = Vec8::load(rows + 3 * v * child.count(), child.count());

  LeavesNearby::Leaf& leaf = nearby.leaves.emplace_back();
  leaf.slot = slot.node * kLanes + slot.lane;
  const LeafFeatures& features = mesh.of(slot);
  leaf.against = {in_other.rotation * features.against.axis, features.against.cosine};
  leaf.corners_begin = static_cast<std::uint32_t>(nearby.corners.size());
  const LeafFrame frame_in_other(posed(in_other, boxes, slot.lane));
  const Points points[3] = {Points(frame_in_other.posed(vertices[0])),
                            Points(frame_in_other.posed(vertices[1])),
                            Points(frame_in_other.posed(vertices[2]))};
  addCornersOf(searched, child, features.corners_begin, points);
  leaf.corners_end = static_cast<std::uint32_t>(nearby.corners.size());
  leaf.edges_begin = static_cast<std::uint32_t>(nearby.edges.size());
  addEdgesOf(searched, child, mesh.edgesOf(features), vertices, LeafFrame(posed(in_a, boxes, slot.lane)));
  leaf.edges_end = static_cast<std::uint32_t>(nearby.edges.size());

  const LeafFrame frame(boxes, slot.lane);
  LeavesNearby::Faces& faces = nearby.faces.emplace_back();
  const Vec8 normal = unit(cross(vertices[1] - vertices[0], vertices[2] - vertices[0]));
  faces.faces = planesThrough(vertices[0], normal);
  for (int v = 0; v < 3; ++v) {
    const Vec8 outward = unit(cross(vertices[(v + 1) % 3] - vertices[v], normal));
    faces.edges[v] = planesThrough(vertices[v], outward);
  }

  for (int i = 0; i < 3; ++i) {
    std::ranges::copy(frame.axes[i], leaf.axes[i]);
    leaf.center[i] = frame.axes[i][0] * frame.center[0] + frame.axes[i][1] * frame.center[1] +
                     frame.axes[i][2] * frame.center[2];
    leaf.half_extents[i] =
        boxes.half_extents[i][slot.lane] + reach * leaning(mesh.reachOf(slot.node).lean[i][slot.lane]);
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

/// Eight corners in the frame of the other mesh's leaf.
struct CornersInLeaf {
  float position[3][kLanes];
  unsigned in_box;  ///< those in the box of points over or under the leaf's faces

  HWY_INLINE CornersInLeaf(const LeavesNearby::Corners& corners, const LeavesNearby::Leaf& leaf,
                           float rounding) {
    const Vec8 in_tree = Vec8::load(corners.position[0], kLanes);
    unsigned outside = 0;
    for (int i = 0; i < 3; ++i) {
      const Float8 along = dot(Vec8::all(leaf.axes[i]), in_tree) - Float8(leaf.center[i]);
      outside |= less(Float8(leaf.half_extents[i] + rounding), abs(along));
      along.store(position[i]);
    }
    in_box = kAllLanes & ~outside;
  }
};

HWY_INLINE Float8 heightsOver(const LeavesNearby::Planes& planes, const Vec8& point) {
  return dot(Vec8::load(planes.normal[0], kLanes), point) - Float8::load(planes.height);
}

/// The faces of a leaf, of the first `lanes`, over or under which a point is.
HWY_INLINE unsigned facesUnder(const LeavesNearby::Faces& leaf, unsigned lanes, const Vec8& point,
                               float reach, float rounding) {
  const Float8 height = abs(heightsOver(leaf.faces, point));
  const unsigned near = lanes & ~less(Float8(reach), height);
  if (near == 0) return 0;
  const Float8 slack = height * Float8(static_cast<float>(kAlike)) + Float8(rounding);
  const Float8 beside = max(heightsOver(leaf.edges[0], point),
                            max(heightsOver(leaf.edges[1], point), heightsOver(leaf.edges[2], point)));
  return near & ~less(slack, beside);
}

/// The faces of a leaf whose normals are opposite to a direction in the cone.
HWY_INLINE unsigned facesAgainst(const LeavesNearby::Leaf& leaf, const LeavesNearby::Planes& faces,
                                 const NormalCone& cone) {
  float axis[3];
  for (int i = 0; i < 3; ++i)
    axis[i] =
        leaf.axes[i][0] * cone.axis[0] + leaf.axes[i][1] * cone.axis[1] + leaf.axes[i][2] * cone.axis[2];
  const Vec8 normal = Vec8::load(faces.normal[0], kLanes);
  return less(dot(Vec8::all(axis), normal), Float8(-cone.cosine));
}

/// Of a node's eight boxes: those below which features may be in contact with some in another box, and those
/// below which triangles may meet some there.
struct BoxesNear {
  unsigned contact, meet;
};

/// Compares the boxes of a node with the box of another mesh's slot.
HWY_INLINE BoxesNear boxesNear(const Searched& boxes, std::uint32_t node, const Searched& other, Slot slot,
                               float limit, float rounding) {
  Box8 room(Box8::Unset{}), room_of_one(Box8::Unset{});
  const BoxF box = posed(other.in_other, boxesAt(treeOf(other.mesh.tree()), slot, room_of_one), slot.lane);
  const FaceGaps gaps = faceGaps(boxesOf(treeOf(boxes.mesh.tree()), node, room), box);
  const NodeReach &reaches = boxes.mesh.reachOf(node), &reach = other.mesh.reachOf(slot.node);
  const Float8 all(limit);
  unsigned far = 0, apart = 0, beside_box = 0, beside_boxes = 0;
  for (int i = 0; i < 3; ++i) {
    const Float8 gap = max(gaps.along[i], gaps.along[3 + i]);
    far |= less(all, gap);
    apart |= less(Float8(rounding), gap);
    beside_box |= less(Float8(limit * leaning(reach.lean[i][slot.lane]) + rounding), gaps.along[i]);
    beside_boxes |= less(all * leaning(Float8::load(reaches.lean[i])) + Float8(rounding), gaps.along[3 + i]);
  }
  const unsigned blunt = reach.sharpness[slot.lane] < other.least_sharpness
                             ? kAllLanes
                             : less(Float8::load(reaches.sharpness), Float8(boxes.least_sharpness));
  return {kAllLanes & ~(far | (beside_box & beside_boxes & blunt)), kAllLanes & ~apart};
}

/// Calls visit(slot_of_a, slot_of_b, may_meet) for the pairs of leaves whose features may be in contact;
/// `may_meet`: their triangles may meet.
template <typename Visit>
void walkFeatures(const Searched& a, const Searched& b, float limit, float rounding, Visit&& visit) {
  const Tree &tree_a = treeOf(a.mesh.tree()), &tree_b = treeOf(b.mesh.tree());
  struct Entry {
    Slot a, b;
    bool may_meet;
  };
  TraversalStack<Entry, 2 * Tree::kMaxDepth> to_do;
  to_do.push({Tree::kRoot, Tree::kRoot, true});
  while (!to_do.empty()) {
    const Entry pair = to_do.pop();
    const Child child_a = tree_a.child(pair.a), child_b = tree_b.child(pair.b);
    if (child_a.isEmpty() || child_b.isEmpty()) continue;
    if (child_a.isLeaf() && child_b.isLeaf()) {
      visit(pair.a, pair.b, pair.may_meet);
    } else if (child_b.isLeaf() || (!child_a.isLeaf() &&
                                    largestHalfExtent(tree_a, pair.a) >= largestHalfExtent(tree_b, pair.b))) {
      const BoxesNear near = boxesNear(a, child_a.node(), b, pair.b, limit, rounding);
      for (const std::uint32_t lane : Lanes(near.contact))
        to_do.push({{child_a.node(), lane}, pair.b, pair.may_meet && (near.meet >> lane & 1u) != 0});
    } else {
      const BoxesNear near = boxesNear(b, child_b.node(), a, pair.a, limit, rounding);
      for (const std::uint32_t lane : Lanes(near.contact))
        to_do.push({pair.a, {child_b.node(), lane}, pair.may_meet && (near.meet >> lane & 1u) != 0});
    }
  }
}

void addNearFeatures(const MeshFeatures& a, const MeshFeatures& b, const Pose& b_in_a, double reach,
                     float least_sharpness, LeavesNearby& of_a, LeavesNearby& of_b, NearFeatures& near) {
  const Tree &tree_a = treeOf(a.tree()), &tree_b = treeOf(b.tree());
  const LocalPose pose(tree_a, tree_b, b_in_a);
  if (!(pose.size <= kFarthest)) return;  // the pose is not finite
  const float limit = pose.limit(reach), rounding = pose.limit(0.0);
  const Searched searched_a{a, pose.a_to_b, PoseF(Pose()), limit, least_sharpness, of_a},
      searched_b{b, pose.b_to_a, pose.b_to_a, limit, least_sharpness, of_b};
  const bool has_sheets = a.hasSheets() || b.hasSheets();
  const auto addPairs = [&](const LeavesNearby& own, const LeavesNearby::Leaf& leaf,
                            const LeavesNearby::Leaf& other, const LeavesNearby::Faces& faces,
                            std::span<const std::uint32_t> triangles,
                            std::vector<CornerAndFace>& found) HWY_ATTR {
    unsigned lanes = (1u << triangles.size()) - 1u;
    if (!has_sheets) lanes &= facesAgainst(other, faces.faces, leaf.against);
    if (lanes == 0) return;
    for (std::uint32_t c = leaf.corners_begin; c < leaf.corners_end; ++c) {
      const LeavesNearby::Corners& corners = own.corners[c];
      const CornersInLeaf in_leaf(corners, other, rounding);
      for (const std::uint32_t lane : Lanes(in_leaf.in_box)) {
        const auto& [x, y, z] = in_leaf.position;
        const Vec8 point{Float8(x[lane]), Float8(y[lane]), Float8(z[lane])};
        for (const std::uint32_t face : Lanes(facesUnder(faces, lanes, point, limit, rounding)))
          found.push_back({corners.corner[lane], corners.triangle[lane], triangles[face]});
      }
    }
  };
  const auto addMeeting = [&](const TrianglePair& pair, bool meets) {
    if (meets || intersects(tree_a.mesh(), tree_b.mesh(), b_in_a, pair)) near.meeting.push_back(pair);
    return false;
  };
  const auto visit = [&](Slot slot_a, Slot slot_b, bool may_meet) HWY_ATTR {
    if (may_meet) forEachCandidateInLeaves(tree_a, tree_b, pose, slot_a, slot_b, addMeeting);
    const std::uint32_t place_a = placeOf(searched_a, slot_a), place_b = placeOf(searched_b, slot_b);
    const LeavesNearby::Leaf &leaf_a = of_a.leaves[place_a], &leaf_b = of_b.leaves[place_b];
    addPairs(of_a, leaf_a, leaf_b, of_b.faces[place_b], tree_b.triangles(tree_b.child(slot_b)),
             near.corners_of_a);
    addPairs(of_b, leaf_b, leaf_a, of_a.faces[place_a], tree_a.triangles(tree_a.child(slot_a)),
             near.corners_of_b);
    for (std::uint32_t i = leaf_a.edges_begin; i < leaf_a.edges_end; ++i) {
      for (std::uint32_t j = leaf_b.edges_begin; j < leaf_b.edges_end; ++j) {
        const LeavesNearby::Edge &edge_a = of_a.edges[i], &edge_b = of_b.edges[j];
        const float x = edge_a.middle[0] - edge_b.middle[0], y = edge_a.middle[1] - edge_b.middle[1],
                    z = edge_a.middle[2] - edge_b.middle[2], far = edge_a.radius + edge_b.radius + limit;
        if (x * x + y * y + z * z <= far * far) near.edges.push_back({edge_a.edge, edge_b.edge});
      }
    }
  };
  walkFeatures(searched_a, searched_b, limit, rounding, visit);
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
  meeting.clear();
  const auto prepare = [](LeavesNearby& nearby, const MeshFeatures& mesh) {
    for (const LeavesNearby::Leaf& leaf : nearby.leaves) nearby.place[leaf.slot] = kNoIndex;
    nearby.leaves.clear();
    nearby.faces.clear();
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
