// Kinematic bodies that meet static ones: a tool that is moved along a path, and the part that it must not
// touch.
#pragma once

class btDynamicsWorld;
class btRigidBody;

namespace octoblisk {

/// Makes the body kinematic and never asleep, and adds it to the world so that pairs with static bodies, as
/// the world's own addRigidBody adds those, have contacts. Added by that, a kinematic body has no broadphase
/// pair with any static one, and no word is said of it. Its group is btBroadphaseProxy::KinematicFilter, its
/// mask all but that: it meets static and dynamic bodies, but no other kinematic one added so, as the parts
/// of one tool touch all the time.
///
/// Such contacts are for reports (contact_report.h); no solver moves either body. The user moves it, by
/// setWorldTransform or by a motion state where the world is stepped, before each
/// performDiscreteCollisionDetection or step.
void addKinematicBody(btDynamicsWorld& world, btRigidBody& body);

}  // namespace octoblisk
