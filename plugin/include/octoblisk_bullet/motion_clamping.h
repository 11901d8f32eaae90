// Keeps fast bodies from passing through concave ones, and concave bodies through others, within a step.
#pragma once

#include <BulletDynamics/Dynamics/btActionInterface.h>

#include <vector>

#include "octoblisk/motion.h"

class btRigidBody;

namespace octoblisk {

/// Bullet's own motion clamping uses a sphere embedded in a convex body. This one uses the exact shapes. If a
/// body would hit another body within a step, it is moved back to where it first comes near that body, and
/// keeps the velocity that it had there. In the next step, Bullet finds the contacts, and the solver bounces
/// or stops the body. MotionClamping is an action, because a world calls actions right after it has moved its
/// bodies. Add it before other actions that move bodies or change velocities. Set `setCcdMotionThreshold` of
/// a body to half its thickness, in world units. docs/bullet.md has an example.
///
/// The parts of a body are its shape, or the children of its compound, if they are ClusteredOctreeShape or
/// convex. The clamping considers a pair of bodies if their filters let them collide and at least one has a
/// motion threshold (default: 0, none). The pair's threshold is the smaller threshold that is set. The
/// clamping compares two parts if at least one is a ClusteredOctreeShape and their relativeLengthBound in the
/// step exceeds the pair's threshold.
///
/// The tolerance is timeOfImpact's default. Parts that are farther apart than 9/8 of it at the start of the
/// step stay at least the tolerance apart, however thin and fast they are. Parts that are nearer move on by
/// at most the threshold. If the threshold is half the thickness, the next contacts usually push the body
/// back to the side from which it came. A thin body that spins fast may still creep through an open mesh in
/// several steps.
///
/// A motion threshold of a convex body also turns on Bullet's own clamping, which runs first. A body that
/// Bullet has moved back stays there, as if it had not moved in the step, and nothing is proved about it. To
/// clamp by the exact shapes instead, set the world's `getDispatchInfo().m_useContinuous` to false, or set
/// only the other body's threshold.
///
/// Cost: a clamped body loses the rest of the step. This happens once per impact, and in every step in which
/// the body slides, rolls or spins in contact by more than the threshold. Its velocity
/// loses what gravity and other forces did in the rest of the step, so that the energy of a pile does not
/// rise. Dynamic bodies whose paths in the step come near each other share one fraction, so that none moves
/// into a place that another should have left. Two bodies share a fraction only if at least one has a part of
/// our shape.
///
/// Limits: two convex bodies or parts are left to Bullet. Parts of other shapes neither stop nor are stopped.
/// Kinematic bodies and links of multibodies count where they are at the end of the step. Displacements by
/// the solver's split impulses are not seen.
class MotionClamping final : public btActionInterface {
 public:
  /// A body that was moved back in the last step, and the fraction of the step that it moved.
  struct Clamped {
    const btRigidBody* body = nullptr;
    btScalar fraction = 1;
  };

  void updateAction(btCollisionWorld* world, btScalar dt) override;
  void debugDraw(btIDebugDraw*) override {}

  /// Those of the last step, in the world's order of bodies. Do not use a body that was deleted since.
  const std::vector<Clamped>& clamped() const { return clamped_; }

 private:
  /// A body with a part that is compared, and its motion in the step.
  struct Mover {
    btCollisionObject* object;
    bool ours;           // has a part of our shape
    btRigidBody* moved;  // null if Bullet did not move it
    Motion motion;
    Aabb swept;
    std::size_t island;  // the index of a mover in it, or its own
    double fraction;     // of its island, if it is the first
  };

  void collect(btCollisionWorld& world, btScalar dt);
  void join(std::size_t first, std::size_t second);
  std::size_t islandOf(std::size_t mover) const;
  double freeFraction(const Mover& first, const Mover& second, double until) const;

  std::vector<Mover> movers_;
  std::vector<std::size_t> by_start_;  // movers by the least x of their swept boxes
  std::vector<Clamped> clamped_;
};

}  // namespace octoblisk
