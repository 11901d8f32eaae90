// Whether two bodies are near each other according to the clusters of their shapes: the broadphase's second
// test.
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>

#include <unordered_map>

struct btBroadphasePair;
struct btBroadphaseProxy;
class btCollisionShape;
class btDispatcher;

namespace octoblisk::detail {

/// holdsOurShape with a memory for large compounds: a compound with thousands of children may be in as many
/// pairs. The stored answers are valid as long as no shape changes.
class HolderCache {
 public:
  bool holdsOurShape(const btCollisionShape& shape);
  void forget() { large_.clear(); }

 private:
  std::unordered_map<const btCollisionShape*, bool> large_;
};

/// Whether clusters decide about the pair: one of the two bodies has clusters, and both are rigid bodies,
/// links of multibodies or plain collision objects. Ghosts (which represent their boxes), soft bodies,
/// user-defined clients and null are judged by their boxes.
bool clustersDecide(const btBroadphaseProxy& a, const btBroadphaseProxy& b, HolderCache& holders);

/// Whether clusters decide about the pair, or would if a child with clusters were added to a compound.
/// Searches no compound.
bool clustersMayDecide(const btBroadphaseProxy& a, const btBroadphaseProxy& b);

/// Whether both bodies are inactive and the dispatcher, if any, ignores such a pair, as Bullet's does.
bool bothSleep(const btBroadphaseProxy& a, const btBroadphaseProxy& b, btDispatcher* dispatcher);

/// Whether a contact of the pair's last dispatch still holds at the current transforms, by the criterion of
/// its manifold. If so, the bodies are near each other, unless a shape has changed since. `room` is a buffer
/// for the pair's manifolds.
bool aContactHolds(const btBroadphasePair& pair, btManifoldArray& room);

/// Whether the two bodies may touch at their current transforms. They may
/// - if a cluster of the given depth (query/clusters_near.h) meets a cluster or the box of the other body;
/// each
///   is grown by its shape's margin and contact breaking threshold;
/// - if one body is inside the other, and the other is a solid.
/// A compound that contains a ClusteredOctreeShape is tested child by child. Any other body is represented by
/// two boxes, that of its proxy and that of its shape. They differ if the body was moved by hand. With
/// `ahead`, false also proves that the bodies stay apart until both together have moved by this length; not
/// for compounds. Call this only if clustersDecide is true.
bool clustersMeet(const btBroadphaseProxy& a, const btBroadphaseProxy& b, int depth, HolderCache& holders,
                  double ahead = 0.0);

}  // namespace octoblisk::detail
