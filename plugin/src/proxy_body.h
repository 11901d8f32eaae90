// The body of a proxy of the broadphase.
#pragma once

struct btBroadphaseProxy;
class btCollisionObject;

namespace octoblisk::detail {

/// The body of a proxy, or null.
const btCollisionObject* bodyOf(const btBroadphaseProxy& proxy);

/// Whether an object is a rigid body, a link of a multibody or a plain collision object, and has a shape.
bool isBody(const btCollisionObject* object);

}  // namespace octoblisk::detail
