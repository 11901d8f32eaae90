// Whether two bodies come near, as far as the clusters of our shapes tell: the broadphase's second question.
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>

#include <unordered_map>

struct btBroadphasePair;
struct btBroadphaseProxy;
class btCollisionShape;
class btDispatcher;

namespace octoblisk::detail {

/// Whether the shape is ours, or a compound that holds ours at any depth.
bool holdsClusters(const btCollisionShape& shape);

/// holdsClusters, asked once of a compound with thousands of children, which may have as many pairs. What it
/// remembers holds for as long as no shape changes.
class ClusterHolders {
 public:
  bool contain(const btCollisionShape& shape);
  void forget() { large_.clear(); }

 private:
  std::unordered_map<const btCollisionShape*, bool> large_;
};

/// Whether clusters have a say in the pair: one of the two holds them, and both are rigid bodies, links of
/// multibodies or plain collision objects. Ghosts (which stand for their boxes), soft bodies, clients of the
/// user's own and null are taken by their boxes.
bool clustersDecide(const btBroadphaseProxy& a, const btBroadphaseProxy& b, ClusterHolders& holders);
bool clustersDecide(const btBroadphaseProxy& a, const btBroadphaseProxy& b);

/// Whether clusters have a say, or would if a compound got a child with clusters. No compound is searched.
bool mayHaveSay(const btBroadphaseProxy& a, const btBroadphaseProxy& b);

/// Whether both are bodies that are not active, and the dispatcher leaves such a pair alone, as Bullet's
/// does.
bool bothSleep(const btBroadphaseProxy& a, const btBroadphaseProxy& b, btDispatcher& dispatcher);

/// Whether a contact of the pair's last dispatch holds at the present transforms, as its manifold would
/// judge: then the two are near, unless a shape was changed since. `room` is for the pair's manifolds.
bool aContactHolds(const btBroadphasePair& pair, btManifoldArray& room);

/// False where clusters keep the two apart at their present transforms: no cluster of the given depth
/// (contact/clusters_near.h), grown by its shape's margin and contact breaking threshold, meets a grown
/// cluster or the box of the other, and neither is inside the other as a solid. A compound with our shape in
/// it counts child by child. Any other body is the box of its proxy and the box of its shape: they differ if
/// the body was moved by hand. Only for pairs for which clustersDecide is true.
bool clustersMeet(const btBroadphaseProxy& a, const btBroadphaseProxy& b, int depth, ClusterHolders& holders);

}  // namespace octoblisk::detail
