// The contact between a triangle and a convex body.
#pragma once

#include <optional>

#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// The contact of a triangle (A) and a convex body (B), both in the body's frame; none if they are farther
/// apart than `threshold`. If they meet, the distance is minus the length of the shortest translation that
/// separates the triangle from the body.
std::optional<Contact> contactOf(const Triangle& triangle, const Convex& convex, double threshold);

/// A convex body (B) among triangles (A) of another frame.
class PosedConvex {
 public:
  /// The pose is in the triangles' frame. The convex body must outlive the object.
  PosedConvex(const Convex& convex, const Pose& pose);

  /// Like contactOf, in the triangles' frame.
  std::optional<Contact> contactWith(const Triangle& triangle, double threshold) const;

 private:
  const Convex& convex_;
  const Pose pose_, inverse_;
  const double radius_;
  std::optional<Vec3> center_;  // of a ball
};

}  // namespace octoblisk::detail
