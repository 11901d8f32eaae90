#include "octoblisk/containment.h"

#include <algorithm>
#include <array>
#include <optional>

#include "octoblisk/collide.h"
#include "octoblisk/half_line_crossing.h"
#include "octoblisk/leaf_triangles.h"
#include "octoblisk/traversal.h"

namespace octoblisk {
namespace {

/// The part of a half-line that may meet a tree, in single precision and in the tree's local frame.
struct Segment {
  Eigen::Vector3f center, direction;  // unit
  float half_length;
  float slack;  // room for rounding
};

/// The part of the half-line from a point along +x of the frame A that lies in the sphere round a tree.
std::optional<Segment> clipToSphere(const ClusteredOctree& tree, const Vec3& point, const Pose& tree_in_a) {
  constexpr double kDoubleRounding = 0x1p-48;
  const Vec3 direction = tree_in_a.rotation.row(0).transpose();
  const Vec3 start = tree_in_a.rotation.transpose() * (point - tree_in_a.translation) - tree.origin();
  const double slack = kTraversalRounding * 3.0 * tree.radius() +
                       kDoubleRounding * (point.norm() + tree_in_a.translation.norm() + tree.origin().norm());
  const double reach = tree.radius() + slack;
  const double nearest = -start.dot(direction);
  const Vec3 middle = start + nearest * direction;
  const double begin = std::max(0.0, nearest - reach), end = nearest + reach;
  if (end < begin || middle.norm() > reach) return std::nullopt;
  const Vec3 center = middle + (0.5 * (begin + end) - nearest) * direction;
  return Segment{center.cast<float>(), direction.cast<float>(), static_cast<float>(0.5 * (end - begin)),
                 static_cast<float>(slack)};
}

/// One bit for each of the eight boxes that the segment may meet: the six axes that may separate the two.
unsigned boxesMet(const Box8& boxes, const Segment& segment) {
  Float8 offset[3], along[3], along_size[3];
  const Float8 x = segment.center.x() - boxes.center[0], y = segment.center.y() - boxes.center[1],
               z = segment.center.z() - boxes.center[2];
  for (int j = 0; j < 3; ++j) {
    offset[j] = x * boxes.axes[0][j] + y * boxes.axes[1][j] + z * boxes.axes[2][j];
    along[j] = boxes.axes[0][j] * segment.direction.x() + boxes.axes[1][j] * segment.direction.y() +
               boxes.axes[2][j] * segment.direction.z();
    along_size[j] = along[j].abs();
  }
  Float8 gap = Float8::Constant(-1e30f);
  for (int j = 0; j < 3; ++j) {
    const int k = (j + 1) % 3, l = (j + 2) % 3;
    gap = gap.max(offset[j].abs() - boxes.half_extents[j] - segment.half_length * along_size[j]);
    gap = gap.max((offset[k] * along[l] - offset[l] * along[k]).abs() -
                  boxes.half_extents[k] * along_size[l] - boxes.half_extents[l] * along_size[k]);
  }
  unsigned met = 0;
  for (int lane = 0; lane < kLanes; ++lane) met |= static_cast<unsigned>(gap[lane] <= segment.slack) << lane;
  return met;
}

/// Calls visit(leaf) for all leaves that the segment may meet, until visit returns true.
template <typename Visit>
void traverseSegment(const ClusteredOctree& tree, const Segment& segment, Visit&& visit) {
  std::array<Child, (kLanes - 1) * ClusteredOctree::kMaxDepth + 1> open;
  std::size_t count = 0;
  open[count++] = tree.child(ClusteredOctree::kRoot);
  while (count > 0) {
    const Child child = open[--count];
    if (child.isLeaf()) {
      if (visit(child)) return;
      continue;
    }
    const ClusteredOctree::Node& node = tree.nodes()[child.node()];
    for (unsigned met = boxesMet(node.boxes, segment); met != 0; met &= met - 1) {
      open[count++] = node.children[static_cast<std::size_t>(std::countr_zero(met))];
    }
  }
}

/// How many parts of one surface lie inside and outside the other solid.
struct PartCount {
  std::size_t inside = 0, outside = 0;
};

PartCount countParts(const Surface& of, const Pose& of_in_a, const Surface& in, const Pose& in_in_a) {
  PartCount count;
  for (std::size_t part = 0; part < of.partCount(); ++part) {
    const Vec3 point = of_in_a * of.position(of.cornerOfPart(part));
    ++(locate(in, point, in_in_a) == PointLocation::inside ? count.inside : count.outside);
  }
  return count;
}

}  // namespace

PointLocation locate(const Surface& surface, const Vec3& point, const Pose& surface_in_a) {
  bool odd = false, on_surface = false;
  if (const std::optional<Segment> segment = clipToSphere(surface.tree(), point, surface_in_a)) {
    traverseSegment(surface.tree(), *segment, [&](Child leaf) {
      for (const std::uint32_t t : surface.tree().triangles(leaf)) {
        const Crossing crossing = halfLineCrossing(point, surface_in_a * surface.tree().mesh().triangle(t));
        odd ^= crossing == Crossing::crossed;
        on_surface |= crossing == Crossing::on_triangle;
      }
      return on_surface;
    });
  }
  if (on_surface) return PointLocation::on_surface;
  if (!surface.isClosed()) return PointLocation::unknown;
  return odd ? PointLocation::inside : PointLocation::outside;
}

Containment containment(const Surface& a, const Surface& b, const Pose& b_in_a) {
  if (collide(a.tree(), b.tree(), b_in_a)) return Containment::touching;
  if (!a.isClosed() || !b.isClosed()) return Containment::unknown;
  // Each part of a surface is now wholly inside or outside the other solid. Where A and B share a point, the
  // shared region is bounded by a part of A's surface in B or one of B's in A; likewise for the region of B
  // that is not in A.
  const Pose identity;
  const PartCount of_a = countParts(a, identity, b, b_in_a), of_b = countParts(b, b_in_a, a, identity);
  if (of_a.inside == 0 && of_b.inside == 0) return Containment::apart;
  if (of_a.inside == 0 && of_b.outside == 0) return Containment::b_inside_a;
  if (of_b.inside == 0 && of_a.outside == 0) return Containment::a_inside_b;
  return Containment::overlapping;
}

}  // namespace octoblisk
