// The persistent manifolds of one pair of bodies: one for each contact patch.
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <vector>

namespace octoblisk {

/// Made when first asked for, kept from step to step so that the solver starts warm, released at the end.
class Manifolds {
 public:
  Manifolds(btDispatcher& dispatcher, const btCollisionObject* body0, const btCollisionObject* body1)
      : dispatcher_(dispatcher), body0_(body0), body1_(body1) {}
  ~Manifolds() {
    for (btPersistentManifold* manifold : manifolds_) dispatcher_.releaseManifold(manifold);
  }
  Manifolds(const Manifolds&) = delete;
  Manifolds& operator=(const Manifolds&) = delete;

  btPersistentManifold* at(std::size_t index) {
    while (manifolds_.size() <= index) manifolds_.push_back(dispatcher_.getNewManifold(body0_, body1_));
    return manifolds_[index];
  }
  std::size_t size() const { return manifolds_.size(); }

  void appendTo(btManifoldArray& array) const {
    for (btPersistentManifold* manifold : manifolds_) array.push_back(manifold);
  }

 private:
  btDispatcher& dispatcher_;
  const btCollisionObject* body0_;
  const btCollisionObject* body1_;
  std::vector<btPersistentManifold*> manifolds_;
};

}  // namespace octoblisk
