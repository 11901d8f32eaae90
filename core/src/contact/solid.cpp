#include "contact/solid.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "octoblisk/closest_point.h"
#include "query/farthest_vertex.h"
#include "query/locate_in_closed.h"

namespace octoblisk::detail {
namespace {

/// A contact that pushes B out of A along the line from a point inside to the closest point of the surface.
/// `farthest_of_b(direction)` is the farthest point of B, or of the part of B that is to get out. The surface
/// is no farther away than `upper_bound`.
template <typename Farthest>
Contact wayOutFrom(const ClusteredOctree& a, const Vec3& inside, Farthest&& farthest_of_b,
                   double upper_bound = std::numeric_limits<double>::infinity()) {
  const ClosestPoint closest = *closestPoint(a, inside, upper_bound);
  const double on_surface = 1e-9 * a.mesh().bounds().halfExtents().norm();
  const Vec3 facing = scaledNormal(a.mesh().triangle(closest.triangle));
  Vec3 inward = closest.distance > on_surface || facing.isZero(0.0) ? Vec3(inside - closest.point) : -facing;
  if (inward.isZero(0.0)) inward = Vec3::UnitX();  // on a triangle without area
  Contact contact;
  contact.normal = inward.normalized();
  contact.point_on_a = closest.point;
  contact.point_on_b = farthest_of_b(contact.normal);
  contact.distance = (contact.point_on_a - contact.point_on_b).dot(contact.normal);
  contact.triangle_a = closest.triangle;
  return contact;
}

/// The radius of a ball around the middle of the core that is inside the body. -infinity if it is not known,
/// because the faces are not, or if the middle is outside the core.
double innerRadius(const Convex& convex) {
  constexpr double kUnknown = -std::numeric_limits<double>::infinity();
  const HullFaces hull = convex.faces();
  if (hull.empty()) return kUnknown;
  const Vec3 middle = convex.middle();
  double radius = std::numeric_limits<double>::infinity();
  for (const HullFace& face : hull.faces) radius = std::min(radius, face.offset - face.normal.dot(middle));
  return radius < 0.0 ? kUnknown : radius + convex.radius();
}

}  // namespace

bool isInSolid(const ClusteredOctree& tree, const Vec3& point) {
  const Aabb& bounds = tree.mesh().bounds();
  if (!bounds.meets({point, point})) return false;
  // Usually, the shortest way out of the bounds meets the fewest boxes.
  Eigen::Index axis_down, axis_up;
  const double down = (point - bounds.min).minCoeff(&axis_down), up = (bounds.max - point).minCoeff(&axis_up);
  const Eigen::Index axis = down < up ? axis_down : axis_up;
  const double sense = down < up ? -1.0 : 1.0;
  Pose turn{Mat3::Zero(), Vec3::Zero()};  // by right angles, so without rounding; the way out becomes +x
  turn.rotation(0, axis) = turn.rotation(1, (axis + 1) % 3) = sense;
  turn.rotation(2, (axis + 2) % 3) = 1.0;
  return locateInClosed(tree, turn * point, turn) == PointLocation::inside;
}

bool PointInSolid::contains(const ClusteredOctree& tree, const Vec3& point,
                            FunctionRef<double()> leastClearance) {
  const bool is_first = !last_;
  const double moved = is_first ? std::numeric_limits<double>::infinity() : (point - *last_).norm();
  last_ = point;
  clearance_ -= moved;
  if (!tree.mesh().bounds().meets({point, point})) return is_inside_ = false;
  if (clearance_ > 0.0) return is_inside_;
  clearance_ = leastClearance();
  if (moved < clearance_) return is_inside_;
  is_inside_ = isInSolid(tree, point);
  // A single test does not need the clearance.
  if (!is_first && clearance_ <= 0.0) clearance_ = closestPoint(tree, point)->distance;
  return is_inside_;
}

void toSolidContacts(const ClusteredOctree& tree, const Convex& convex, const Pose& convex_in_mesh,
                     double reach, PointInSolid& middle, std::vector<Contact>& contacts) {
  const Vec3 center = convex_in_mesh * convex.middle();
  // A triangle that comes nearer to the middle is as much deeper in the ball around it.
  const auto leastClearance = [&] {
    double least_distance = reach;
    for (const Contact& contact : contacts) least_distance = std::min(least_distance, contact.distance);
    return innerRadius(convex) + least_distance;
  };
  const auto farthestOfConvex = [&](const Vec3& direction) -> Vec3 {
    return convex_in_mesh * convex.support(convex_in_mesh.rotation.transpose() * direction) +
           convex.radius() * direction;
  };
  if (middle.contains(tree, center, leastClearance)) {
    const Contact out = wayOutFrom(tree, center, farthestOfConvex);
    std::erase_if(contacts, [&](const Contact& contact) { return contact.normal.dot(out.normal) <= 0.0; });
    contacts.push_back(out);
    return;
  }
  // Triangles that the core pierces push it sideways. The way out of its end leads to its middle.
  Vec3 towards_end = Vec3::Zero();
  for (const Contact& contact : contacts) {
    if (contact.distance <= -convex.radius()) towards_end += contact.point_on_a - center;
  }
  if (!towards_end.isZero(0.0)) {
    const Vec3 end = convex_in_mesh * convex.support(convex_in_mesh.rotation.transpose() * towards_end);
    if (end != center && isInSolid(tree, end)) {
      const auto farthestOfEnd = [&](const Vec3& direction) -> Vec3 {
        return end + convex.radius() * direction;
      };
      double upper_bound = std::numeric_limits<double>::infinity();
      for (const Contact& contact : contacts)
        upper_bound = std::min(upper_bound, distance(tree.mesh().triangle(contact.triangle_a), end));
      const Contact out = wayOutFrom(tree, end, farthestOfEnd, upper_bound);
      if (out.normal.dot(center - out.point_on_a) < 0.0) contacts.push_back(out);
    }
  }
  const auto pushesThrough = [&](const Contact& contact) {
    const double behind = contact.normal.dot(center - contact.point_on_a);
    return behind > 0.0 && behind <= -contact.distance;
  };
  const auto holds = [&](const Contact& contact) {
    return contact.distance <= 0.0 && !pushesThrough(contact);
  };
  if (std::ranges::any_of(contacts, holds)) std::erase_if(contacts, pushesThrough);
}

FarVertices farVertices(const ClusteredOctree& tree) {
  FarVertices far;
  std::size_t count = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vec3 direction(x, y, z);
        const double axes = direction.squaredNorm();
        if (axes == 1.0 || axes == 3.0) far.positions[count++] = farthestVertex(tree, direction);
      }
    }
  }
  return far;
}

void FarVerticesInSolid::find(const ClusteredOctree& a, const ClusteredOctree& b, const FarVertices& far_of_b,
                              const Pose& b_in_a, bool meet, double least_depth,
                              std::vector<Contact>& ways_out) {
  ways_out.clear();
  const auto add = [&](Contact out) {
    out.triangle_b = closestPoint(b, b_in_a.inverse() * out.point_on_b)->triangle;
    ways_out.push_back(out);
  };
  const auto forEachInside = [&](auto&& visit) {
    for (std::size_t v = 0; v < in_a_.size(); ++v) {
      const Vec3 vertex = b_in_a * far_of_b.positions[v];
      if (in_a_[v].contains(a, vertex)) visit(vertex);
    }
  };
  if (meet) {
    forEachInside([&](const Vec3& vertex) {
      const Contact out = wayOutFrom(a, vertex, [&](const Vec3&) { return vertex; });
      if (out.distance < -least_depth) add(out);
    });
    return;
  }
  std::optional<Contact> of_all;  // the way out of all of B
  const auto findWayOfAll = [&](const Vec3& inside) {
    of_all = wayOutFrom(a, inside, [&](const Vec3& direction) -> Vec3 {
      return b_in_a * farthestVertex(b, b_in_a.rotation.transpose() * direction);
    });
  };
  const auto addWayOfAll = [&](const Vec3& point_on_b) {
    Contact out = *of_all;
    out.distance = (out.point_on_a - point_on_b).dot(out.normal);
    const bool is_known = std::ranges::find(ways_out, point_on_b, &Contact::point_on_b) != ways_out.end();
    if (!(out.distance < 0.0) || is_known) return;
    out.point_on_a = point_on_b + out.distance * out.normal;
    out.point_on_b = point_on_b;
    out.triangle_a = closestPoint(a, out.point_on_a)->triangle;
    add(out);
  };
  forEachInside([&](const Vec3& vertex) {
    if (!of_all) {
      const Vec3 middle = b_in_a * b.mesh().bounds().center();
      if (isInSolid(a, middle)) findWayOfAll(middle);
      if (!of_all || !(of_all->distance < 0.0)) findWayOfAll(vertex);  // the middle may be outside B
      addWayOfAll(of_all->point_on_b);
    }
    addWayOfAll(vertex);  // contacts that are spread over B do not turn it
  });
}

}  // namespace octoblisk::detail
