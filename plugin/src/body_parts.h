// The parts of a body's shape that are swept: our shapes and convex shapes.
#pragma once

#include "bullet_convex.h"
#include "octoblisk/motion.h"
#include "orthonormal_pose.h"
#include "our_shape.h"

namespace octoblisk::detail {

/// A body's shape on a motion.
struct MovingBody {
  const btCollisionShape& shape;
  Motion in_world;
};

/// A body's shape, or a child of its compound at any depth.
struct BodyPart {
  const btCollisionShape* shape;
  const ClusteredOctreeShape* ours;  ///< null if the part is convex
  const Convex* convex;              ///< null if the part is ours; valid during the visit only
  Motion in_world;

  BodyBounds bounds() const { return ours ? BodyBounds(ours->tree()) : BodyBounds(*convex); }
  /// The margin that the sweep leaves out. The sweep of a convex shape includes its margin.
  double margin() const { return ours ? double(ours->getMargin()) : 0.0; }
};

/// Calls visit(part) for every part of our shape and, with `with_convex`, for every convex part. `corners`
/// holds the corners of a convex part during its visit.
template <typename Visit>
void forEachPart(const MovingBody& body, bool with_convex, ConvexCore& corners, const Visit& visit) {
  const btCollisionShape& shape = body.shape;
  if (shape.isCompound()) {
    const auto& compound = static_cast<const btCompoundShape&>(shape);
    for (int i = 0; i < compound.getNumChildShapes(); ++i) {
      forEachPart(MovingBody{*compound.getChildShape(i),
                             body.in_world.ofPart(orthonormalPose(compound.getChildTransform(i)))},
                  with_convex, corners, visit);
    }
  } else if (const ClusteredOctreeShape* ours = asOurShape(shape)) {
    visit(BodyPart{&shape, ours, nullptr, body.in_world});
  } else if (with_convex && shape.isConvex()) {
    const auto& convex_shape = static_cast<const btConvexShape&>(shape);
    corners.update(convex_shape);
    const BulletConvex convex(convex_shape, corners);
    visit(BodyPart{&shape, nullptr, &convex, body.in_world});
  }
}

/// Calls visit(a, b) for every part of A and every part of B if at least one of the two is ours.
template <typename Visit>
void forEachPartPair(const MovingBody& a, const MovingBody& b, const Visit& visit) {
  thread_local ConvexCore corners;  // kept, so that warm sweeps allocate nothing
  forEachPart(a, holdsOurShape(b.shape), corners, [&](const BodyPart& part_a) {
    forEachPart(b, part_a.ours != nullptr, corners, [&](const BodyPart& part_b) { visit(part_a, part_b); });
  });
}

}  // namespace octoblisk::detail
