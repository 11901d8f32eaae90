// This query has its own descent: each box passes the source's triangles that it has found to its children.
#include "octoblisk/source_contacts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "geometry/triangle_pair.h"
#include "query/by_triangles.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

constexpr std::size_t kFew = 256;          // candidates that are thinned out instead of requested again
constexpr double kRoundingOfBoxes = 1e-5;  // their axes are orthonormal to single precision

bool isFinite(const Triangle& triangle) {
  return triangle[0].allFinite() && triangle[1].allFinite() && triangle[2].allFinite();
}

/// Whether the plane of `triangle` is farther than `reach` from the whole of `other`.
bool planeParts(const Triangle& triangle, const Triangle& other, double reach) {
  const Vec3 normal = scaledNormal(triangle);
  const double longest =
      std::max((triangle[1] - triangle[0]).squaredNorm(), (triangle[2] - triangle[0]).squaredNorm());
  const double farthest = std::sqrt(longest) + (other[0] - triangle[0]).norm() + triangle[0].norm();
  const double limit = reach * normal.norm() + 1e-14 * longest * farthest;
  const double first = normal.dot(other[0] - triangle[0]), second = normal.dot(other[1] - triangle[0]),
               third = normal.dot(other[2] - triangle[0]);
  return std::min({first, second, third}) > limit || std::max({first, second, third}) < -limit;
}

auto byNumbers(const SourceTriangle& t) {
  const auto key = [](const Vec3& v) { return std::tuple(v.x(), v.y(), v.z()); };
  return std::tuple(t.part, t.index, key(t.corners[0]), key(t.corners[1]), key(t.corners[2]));
}

}  // namespace

/// The constant data of a search, including the rounding bounds that keep its tests from missing anything.
class SourceContacts::Query {
 public:
  Query(const Tree& tree, const TriangleSource& triangles, const Pose& pose, double limit,
        std::vector<Contact>& contacts)
      : a(tree), b(triangles), b_in_a(pose), threshold(limit), found(contacts) {
    rotation_to_b_ = pose.rotation.inverse();  // its transpose may be exact to single precision only
    const double size = a.origin().norm() + a.radius() + pose.translation.norm() + threshold;
    reach_ = (1.0 + kRoundingOfBoxes) * threshold + 1e-12 * size;
    bounds_of_b_ = b.bounds();
    largest_of_b_ = bounds_of_b_.halfExtents().maxCoeff();
  }

  /// The bounds, in B's frame, of a box in A's frame, grown by the threshold.
  Aabb grownInB(const Obb& box) const {
    const Vec3 center = rotation_to_b_ * (box.center - b_in_a.translation);
    const Mat3 axes = rotation_to_b_ * box.axes;
    const Vec3 half_extents =
        (1.0 + kRoundingOfBoxes) * (axes.cwiseAbs() * box.half_extents + Vec3::Constant(reach_));
    return {center - half_extents, center + half_extents};
  }

  /// Whether a box in B's frame may contain triangles of B.
  bool meetsB(const Aabb& box) const { return box.meets(bounds_of_b_); }

  /// Whether a box in B's frame covers too much of B to request all triangles in it.
  bool isLargeInB(const Aabb& box) const { return box.halfExtents().maxCoeff() > 0.25 * largest_of_b_; }

  /// Whether a triangle in A's frame may be within the threshold of a box.
  bool isNear(const Obb& box, const Triangle& triangle) const {
    const Vec3 p = box.axes.transpose() * (triangle[0] - box.center);
    const Vec3 q = box.axes.transpose() * (triangle[1] - box.center);
    const Vec3 r = box.axes.transpose() * (triangle[2] - box.center);
    const Vec3 limit = box.half_extents + Vec3::Constant(reach_);
    return (p.cwiseMin(q).cwiseMin(r).array() <= limit.array()).all() &&
           (p.cwiseMax(q).cwiseMax(r).array() >= -limit.array()).all();
  }

  /// Appends the contact of two triangles in A's frame, if they are within the threshold.
  bool append(const Triangle& of_a, const Triangle& of_b, std::uint32_t index_a, std::size_t index_b) const {
    if (!boundsOf(of_a).grown(reach_).meets(boundsOf(of_b))) return false;
    if (planeParts(of_a, of_b, reach_) || planeParts(of_b, of_a, reach_)) return false;
    Contact contact = contactOf(of_a, of_b);
    if (!(contact.distance <= threshold)) return false;
    contact.triangle_a = index_a;
    contact.triangle_b = static_cast<std::uint32_t>(index_b);
    found.push_back(contact);
    return true;
  }

  const Tree& a;
  const TriangleSource& b;
  const Pose& b_in_a;
  const double threshold;
  std::vector<Contact>& found;

 private:
  Mat3 rotation_to_b_;
  double reach_ = 0.0, largest_of_b_ = 0.0;
  Aabb bounds_of_b_;
};

void SourceContacts::find(const ClusteredOctree& a, const TriangleSource& b, const Pose& b_in_a,
                          double threshold, std::vector<Contact>& found) {
  found.clear();
  touched_.clear();
  descend(Query(treeOf(a), b, b_in_a, threshold, found), Tree::kRoot, {});
  numberTouched(found);
}

void SourceContacts::descend(const Query& query, Slot slot, const Nearby& above) {
  const Child child = query.a.child(slot);
  if (child.isEmpty()) return;
  const std::size_t candidates = candidates_.size(), near = near_.size();
  const Nearby nearby = nearbyOf(query, slot, above);
  if (!nearby.listed || nearby.begin != nearby.end) {
    if (child.isLeaf()) {
      testLeaf(query, child, nearby);
    } else {
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) descend(query, {child.node(), lane}, nearby);
    }
  }
  candidates_.resize(candidates);
  near_.resize(near);
}

SourceContacts::Nearby SourceContacts::nearbyOf(const Query& query, Slot slot, const Nearby& above) {
  const Obb box = query.a.box(slot);
  const std::size_t begin = near_.size(), first_candidate = candidates_.size();
  const auto listed = [&] { return Nearby{true, begin, near_.size(), 0}; };
  if (above.listed) {
    for (std::size_t i = above.begin; i < above.end; ++i) {
      if (query.isNear(box, candidates_[near_[i]].in_a)) near_.push_back(near_[i]);
    }
    return listed();
  }
  const Aabb in_b = query.grownInB(box);
  if (!query.meetsB(in_b)) return listed();
  if (!query.a.child(slot).isLeaf()) {
    if (above.levels_to_skip > 0) return {.levels_to_skip = above.levels_to_skip - 1};
    if (query.isLargeInB(in_b)) return {};
  }
  std::size_t count = 0;
  query.b.forEachTriangleIn(in_b, [&](const SourceTriangle& triangle) {
    if (!in_b.meets(boundsOf(triangle.corners)) || !isFinite(triangle.corners)) return;
    const Triangle in_a = query.b_in_a * triangle.corners;
    if (!query.isNear(box, in_a) || ++count > kFew) return;
    near_.push_back(candidates_.size());
    candidates_.push_back({triangle, in_a});
  });
  if (count <= kFew) return listed();
  near_.resize(begin);
  candidates_.resize(first_candidate);
  // A cluster of half the size has a quarter of the surface.
  return {.levels_to_skip = static_cast<int>(std::log2(double(count) / kFew) / 2.0)};
}

void SourceContacts::testLeaf(const Query& query, Child leaf, const Nearby& nearby) {
  for (const std::uint32_t t : query.a.triangles(leaf)) {
    const Triangle triangle = query.a.mesh().triangle(t);
    const auto test = [&](const SourceTriangle& in_b, const Triangle& in_a) {
      if (query.append(triangle, in_a, t, touched_.size())) touched_.push_back(in_b);
    };
    if (nearby.listed) {
      for (std::size_t i = nearby.begin; i < nearby.end; ++i) {
        test(candidates_[near_[i]].in_b, candidates_[near_[i]].in_a);
      }
      continue;
    }
    // There are too many to list, even for a leaf's box.
    const Aabb in_b = query.grownInB(obbOf(boundsOf(triangle)));
    query.b.forEachTriangleIn(in_b, [&](const SourceTriangle& of_b) {
      if (in_b.meets(boundsOf(of_b.corners)) && isFinite(of_b.corners)) {
        test(of_b, query.b_in_a * of_b.corners);
      }
    });
  }
}

void SourceContacts::numberTouched(std::vector<Contact>& found) {
  // Several clusters may have touched a triangle. It gets one number, whichever cluster was first.
  order_.resize(touched_.size());
  number_.resize(touched_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::ranges::sort(order_, {}, [&](std::uint32_t i) { return std::tuple(byNumbers(touched_[i]), i); });
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const bool is_new = i == 0 || byNumbers(touched_[order_[i]]) != byNumbers(touched_[order_[i - 1]]);
    number_[order_[i]] = is_new ? count++ : count - 1;
  }
  for (Contact& contact : found) contact.triangle_b = number_[contact.triangle_b];
  std::ranges::sort(touched_, {}, byNumbers);
  // Clang 14 does not compile std::ranges::unique.
  const auto areOne = [](const SourceTriangle& a, const SourceTriangle& b) {
    return byNumbers(a) == byNumbers(b);
  };
  touched_.erase(std::unique(touched_.begin(), touched_.end(), areOne), touched_.end());

  std::ranges::sort(found, {}, byTriangles);
  const auto areOfOnePair = [](const Contact& a, const Contact& b) { return a.triangles() == b.triangles(); };
  found.erase(std::unique(found.begin(), found.end(), areOfOnePair), found.end());
}

}  // namespace octoblisk
