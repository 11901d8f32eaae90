// All contacts of a pair of bodies, from the algorithm that Bullet dispatches, instead of the few that
// Bullet's manifolds keep.
#pragma once

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <span>

#include "octoblisk/contact.h"

namespace octoblisk {

/// Pass this to an algorithm of registerAlgorithm (register.h) as the result of processCollision. It collects
/// the contacts of all triangle pairs within reach and leaves the pair's manifolds unchanged, unless a shape
/// has changed. The reach is that of a manifold: the contact breaking threshold, the margins, and
/// m_closestPointDistanceThreshold. Do not pass it to other algorithms: they would find no manifold in it.
class AllContacts final : public btManifoldResult {
 public:
  AllContacts(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1)
      : btManifoldResult(body0, body1) {}

  /// The body that is A in the contacts; points and normals are in its frame. Null if no algorithm of this
  /// library has run.
  const btCollisionObject* a() const { return a_; }

  /// Valid until the algorithm runs again or is deleted.
  std::span<const Contact> contacts() const { return contacts_; }

  /// Called by the algorithm.
  void take(const btCollisionObject& a, std::span<const Contact> contacts) {
    a_ = &a;
    contacts_ = contacts;
  }

 private:
  const btCollisionObject* a_ = nullptr;
  std::span<const Contact> contacts_;
};

}  // namespace octoblisk
