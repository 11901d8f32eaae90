// Whether two bodies come near, as far as the clusters of our shapes tell: the broadphase's second question.
#pragma once

struct btBroadphaseProxy;
class btCollisionShape;

namespace octoblisk {

/// Whether the shape is ours, or a compound that holds ours at any depth.
bool holdsClusters(const btCollisionShape& shape);

/// Whether clusters have a say in the pair: one of the two holds them, and both are rigid bodies, links of
/// multibodies or plain collision objects. Ghosts (which stand for their boxes), soft bodies, clients of the
/// user's own and null are taken by their boxes.
bool clustersDecide(const btBroadphaseProxy& a, const btBroadphaseProxy& b);

/// Whether both are bodies that are not active: Bullet dispatches no such pair.
bool bothSleep(const btBroadphaseProxy& a, const btBroadphaseProxy& b);

/// False where clusters keep the two apart at their present transforms: no cluster of the given depth
/// (octoblisk/clusters_near.h), grown by its shape's margin and contact breaking threshold, meets a grown
/// cluster or the box of the other. A compound with our shape in it counts child by child; any other body is
/// its proxy's box. Only for pairs of which clustersDecide is true. Allocates nothing.
bool clustersMeet(const btBroadphaseProxy& a, const btBroadphaseProxy& b, int depth);

}  // namespace octoblisk
