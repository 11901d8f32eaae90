// Keeps fast bodies from getting through concave ones, and these through others, within a step of a Bullet
// world.
#pragma once

#include <BulletDynamics/Dynamics/btActionInterface.h>

#include <vector>

#include "octoblisk/motion.h"

class btRigidBody;

namespace octoblisk {

/// What Bullet's own motion clamping does for convex bodies by an embedded sphere, done by the meshes: a body
/// that would come upon another within a step is put back to where it comes near it, and keeps its velocity.
/// There the next step's detection makes contacts, and the solver bounces or stops it. An action, as it is
/// called right after a world has moved its bodies by what the solver made of their velocities: added before
/// other actions that move bodies or change velocities. `setCcdMotionThreshold` of a body takes half its
/// thickness, in world units. docs/limits.md has an example.
///
/// The parts of a body are its shape, or the children of its compound, that are ClusteredOctreeShape or
/// convex. The clamping looks at pairs of bodies that their filters let collide, if one or both have a motion
/// threshold (default: 0, none). Of such a pair it compares every two parts, one or both of which are
/// ClusteredOctreeShape, if their motion to each other in the step (relativeLengthBound) exceeds the smaller
/// threshold that is set. Two parts farther apart than the default tolerance of timeOfImpact at the step's
/// start do not come nearer than that within the step, however thin and fast they are. Two parts that are
/// nearer go on by no more than the threshold: their contacts are the solver's to keep, and by half the
/// thickness at a time the next contacts still push them back out of the side from which they came.
///
/// A motion threshold of a convex body also turns on Bullet's own clamping of it, which comes first. A body
/// that Bullet has put back stays there, as if it had not moved in the step, and nothing is proved of it. To
/// clamp by the meshes instead, set the world's `getDispatchInfo().m_useContinuous` to false, or set the
/// threshold of the other body alone.
///
/// What is lost: the rest of the step. A body put back has been slower than its velocity says, once for each
/// impact, and all along while it slides, rolls or spins in contact by more than the threshold a step. The
/// dynamic bodies whose ways in the step come near each other share one fraction, so that none moves into
/// where another should have gone. Two bodies without a part of our shape do not share one for each other.
///
/// What is not seen: two convex bodies or parts, which are Bullet's to clamp; parts of all other shapes,
/// which are neither stopped nor stopped at; kinematic bodies and links of multibodies, which are stopped at
/// where they are at the end of the step; what the solver's split impulses shift.
class MotionClamping final : public btActionInterface {
 public:
  /// A body that was put back in the last step, and how much of the step it has moved.
  struct Clamped {
    const btRigidBody* body = nullptr;
    btScalar fraction = 1;
  };

  void updateAction(btCollisionWorld* world, btScalar dt) override;
  void debugDraw(btIDebugDraw*) override {}

  /// In the last step, in the world's order of bodies.
  const std::vector<Clamped>& clamped() const { return clamped_; }

 private:
  /// A body with a part that is looked at, and what it did in the step.
  struct Mover {
    btCollisionObject* object;
    bool ours;           // has a part of our shape
    btRigidBody* moved;  // null where Bullet did not move it
    Motion motion;
    Aabb swept;
    std::size_t island;  // the index of a mover in it, or its own
    double fraction;     // of its island, where it is the first
  };

  void collect(btCollisionWorld& world, btScalar dt);
  void join(std::size_t first, std::size_t second);
  std::size_t islandOf(std::size_t mover) const;
  double freeFraction(const Mover& first, const Mover& second, double until) const;

  std::vector<Mover> movers_;
  std::vector<std::size_t> by_start_;  // movers by the least x of their ways
  std::vector<Clamped> clamped_;
};

}  // namespace octoblisk
