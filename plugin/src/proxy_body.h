// The body of a proxy of the broadphase.
#pragma once

#include "octoblisk/types.h"

struct btBroadphaseProxy;
class btCollisionObject;

namespace octoblisk::detail {

/// The body of a proxy, or null.
const btCollisionObject* bodyOf(const btBroadphaseProxy& proxy);

/// Whether an object is a rigid body, a link of a multibody or a plain collision object, and has a shape.
bool isBody(const btCollisionObject* object);

/// Holds the proxy's box and the box of its body's shape at the body's current transform. They differ if the
/// body was moved by hand: Bullet may leave the proxies of sleeping bodies unchanged
/// (setForceUpdateAllAabbs). The body must have a shape.
Aabb boxOf(const btBroadphaseProxy& proxy);

}  // namespace octoblisk::detail
