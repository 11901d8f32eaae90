// All contacts of a pair of bodies, from the algorithm that Bullet dispatches: not the few that its manifolds
// keep.
#pragma once

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <span>

#include "octoblisk/contact.h"

namespace octoblisk {

/// Given to an algorithm of registerAlgorithm (register.h) as the result of processCollision, takes the
/// contacts of all pairs of triangles within reach, and leaves the pair's manifolds as they are. The reach is
/// that of a manifold: the breaking threshold, the margins, and m_closestPointDistanceThreshold. Algorithms
/// of others find no manifold in it, so that it must not be given to them.
class AllContacts final : public btManifoldResult {
 public:
  AllContacts(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1)
      : btManifoldResult(body0, body1) {}

  /// The body that is A of the contacts, which are in its frame; null where no algorithm of ours has run.
  const btCollisionObject* a() const { return a_; }

  /// The algorithm keeps them until its next run.
  std::span<const Contact> contacts() const { return contacts_; }

  /// For the algorithm.
  void take(const btCollisionObject& a, std::span<const Contact> contacts) {
    a_ = &a;
    contacts_ = contacts;
  }

 private:
  const btCollisionObject* a_ = nullptr;
  std::span<const Contact> contacts_;
};

}  // namespace octoblisk
