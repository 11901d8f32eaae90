// The persistent manifolds of one pair of bodies: one for each contact patch.
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <span>
#include <vector>

#include "contact/contact_patches.h"

namespace octoblisk::detail {

/// The mesh that is A of the patches.
struct PatchesMesh {
  Pose in_world;
  Pose body_in_world;  // of the whole body: the mesh may be a child of its shape
  double margin = 0.0;
  bool is_body1 = false;
};

/// Made when first needed, kept from step to step so that the solver starts warm, released at the end.
class Manifolds {
 public:
  Manifolds(btDispatcher& dispatcher, const btCollisionObject* body0, const btCollisionObject* body1)
      : dispatcher_(dispatcher), body0_(body0), body1_(body1) {}
  ~Manifolds();
  Manifolds(const Manifolds&) = delete;
  Manifolds& operator=(const Manifolds&) = delete;

  /// Gives each patch a manifold: the one that holds the points nearest to it, else one without points.
  /// Points that would keep a contact of the patch out are removed. The manifolds that no patch claims are
  /// emptied; all get the breaking threshold.
  void match(std::span<const ContactPatch> patches, const PatchesMesh& mesh, btScalar breaking_threshold);

  /// The manifold of a patch that was matched last; null if the dispatcher's pool has none left.
  btPersistentManifold* of(std::size_t patch) const {
    return patch < manifolds_.size() ? manifolds_[patch] : nullptr;
  }

  /// Forgets all points, and the impulses with them.
  void clear() {
    for (btPersistentManifold* manifold : manifolds_) manifold->clearManifold();
  }

  void appendTo(btManifoldArray& array) const {
    for (btPersistentManifold* manifold : manifolds_) array.push_back(manifold);
  }

 private:
  /// False: the dispatcher's pool has none left.
  bool add();

  btDispatcher& dispatcher_;
  const btCollisionObject* body0_;
  const btCollisionObject* body1_;
  std::vector<btPersistentManifold*> manifolds_;  // those of patches first, in their order
};

}  // namespace octoblisk::detail
