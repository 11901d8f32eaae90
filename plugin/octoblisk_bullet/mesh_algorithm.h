// What the algorithms of our shape have in common: from contacts of the core to points of Bullet's manifolds.
#pragma once

#include <BulletCollision/CollisionDispatch/btActivatingCollisionAlgorithm.h>

#include <vector>

#include "octoblisk/contact_patches.h"
#include "octoblisk_bullet/manifolds.h"

struct btCollisionObjectWrapper;

namespace octoblisk {

/// The algorithm of a pair of which one body, the mesh, has our shape.
class MeshAlgorithm : public btActivatingCollisionAlgorithm {
 public:
  void processCollision(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                        const btDispatcherInfo& info, btManifoldResult* result) final;
  void getAllContactManifolds(btManifoldArray& array) final { manifolds_.appendTo(array); }

  /// Discrete: the whole step is free.
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) final {
    return 1;
  }

 protected:
  /// `mesh_is_body1`: the pair comes in the order (other, mesh).
  MeshAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* body0,
                const btCollisionObjectWrapper* body1, bool mesh_is_body1);

 private:
  /// Replaces `found` by the contacts of mesh (A) and other (B) within `reach`, in the mesh's frame.
  virtual void findContacts(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other,
                            double reach, std::vector<Contact>& found) const = 0;

  const bool mesh_is_body1_;
  Manifolds manifolds_;
  std::uint32_t revisions_ = 0;  // of the shapes that the manifolds' points are of, summed
  std::vector<Contact> contacts_;
  ContactPatches patches_;
};

}  // namespace octoblisk
