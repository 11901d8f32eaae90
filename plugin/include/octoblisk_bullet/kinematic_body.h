// Contacts between kinematic and static bodies: a tool that moves along a path, and the part that it must not
// touch.
#pragma once

class btDynamicsWorld;
class btRigidBody;

namespace octoblisk {

/// Makes the body kinematic, prevents it from sleeping, and adds it to the world so that it has contacts with
/// static bodies that were added by addRigidBody. If a kinematic body is added by addRigidBody, Bullet
/// silently creates no broadphase pair between it and any static body. The body's group is
/// btBroadphaseProxy::KinematicFilter, and its mask contains all other groups. It therefore meets static and
/// dynamic bodies, but no kinematic body added this way: the parts of one tool touch all the time.
///
/// These contacts are for reports (contact_report.h); the solver moves neither body. Move the body with
/// setWorldTransform, or with a motion state if the world is stepped, before each
/// performDiscreteCollisionDetection or step.
void addKinematicBody(btDynamicsWorld& world, btRigidBody& body);

}  // namespace octoblisk
