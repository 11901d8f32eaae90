// The persistent manifolds of one pair of bodies: one for each contact patch.
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <span>
#include <vector>

#include "contact/contact_patches.h"

namespace octoblisk::detail {

/// The mesh that is body A of the patches.
struct PatchesMesh {
  Pose in_world;
  Pose body_in_world;  // of the whole body; the mesh may be a child of its shape
  double margin = 0.0;
  bool is_body1 = false;
};

/// Creates manifolds when they are first needed, keeps them between steps so that the solver starts warm, and
/// releases them at the end.
class Manifolds {
 public:
  Manifolds(btDispatcher& dispatcher, const btCollisionObject* body0, const btCollisionObject* body1)
      : dispatcher_(dispatcher), body0_(body0), body1_(body1) {}
  ~Manifolds();
  Manifolds(const Manifolds&) = delete;
  Manifolds& operator=(const Manifolds&) = delete;

  /// Gives each patch the manifold whose points and normals are most similar, or else one without points.
  /// Removes points that would block a contact of the patch. Empties the manifolds that no patch claims, and
  /// sets the breaking threshold of all manifolds.
  void match(std::span<const ContactPatch> patches, const PatchesMesh& mesh, btScalar breaking_threshold);

  /// The manifold of a patch in the last match(); null if the dispatcher's pool is exhausted.
  btPersistentManifold* of(std::size_t patch) const {
    return patch < manifolds_.size() ? manifolds_[patch] : nullptr;
  }

  bool empty() const { return manifolds_.empty(); }

  /// Removes all points and their impulses.
  void clear() {
    for (btPersistentManifold* manifold : manifolds_) manifold->clearManifold();
  }

  void appendTo(btManifoldArray& array) const {
    for (btPersistentManifold* manifold : manifolds_) array.push_back(manifold);
  }

 private:
  /// Returns false if the dispatcher's pool is exhausted.
  bool add();

  btDispatcher& dispatcher_;
  const btCollisionObject* body0_;
  const btCollisionObject* body1_;
  std::vector<btPersistentManifold*> manifolds_;  // those of patches first, in the order of the patches
};

}  // namespace octoblisk::detail
