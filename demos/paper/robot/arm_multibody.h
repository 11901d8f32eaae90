// The arm with its tool as a Featherstone body of Bullet: links, colliders, motors and limits of its joints.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointLimitConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <memory>
#include <vector>

#include "octoblisk_bullet/clustered_octree_shape.h"
#include "paper/robot/robot_cell.h"

class btMultiBodyDynamicsWorld;

namespace octoblisk::demos {

/// Links 0 to 5 turn; each part of the tool is a link fixed to the last of them. The frame of a turning
/// Bullet link has the axes of its DH frame and its origin in the centre of mass. A part's frame is the
/// tool's frame, and its mass is included in link 5. Bullet supports only a diagonal inertia of a link, along
/// these axes: products of inertia are dropped.
class ArmMultiBody {
 public:
  ArmMultiBody(const RobotCellSetup& setup, btMultiBodyDynamicsWorld& world);
  ~ArmMultiBody();
  ArmMultiBody(const ArmMultiBody&) = delete;
  ArmMultiBody& operator=(const ArmMultiBody&) = delete;

  std::size_t bodies() const { return colliders_.size(); }
  btMultiBodyLinkCollider& collider(std::size_t body) { return *colliders_[body]; }
  ClusteredOctreeShape& shapeOfPart(std::size_t part) { return *part_shapes_[part]; }

  void place(const Joints& joints);
  Joints joints() const;

  /// Sets the motors' targets for the next step, of `seconds`.
  void command(const Joints& position, const Joints& rate, double seconds);

  /// Moves the colliders to Bullet's links, or to where the links would be at given joints.
  void showBodies();
  void showBodies(const SixAxisArm& arm, const Joints& joints, const Pose& tool_in_base);

  Pose linkFrame(std::size_t link) const;  ///< the frame of a collider at the link
  Pose toolInBase() const;

 private:
  void addCollider(int link, btCollisionShape& shape);

  btMultiBodyDynamicsWorld& world_;
  ServoOptions servo_;
  std::vector<Vec3> centers_;  // of mass, of the turning links
  btMultiBody body_;
  std::vector<std::unique_ptr<btCollisionShape>> link_shapes_;
  std::vector<std::unique_ptr<ClusteredOctreeShape>> part_shapes_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
  std::vector<std::unique_ptr<btMultiBodyJointMotor>> motors_;
  std::vector<std::unique_ptr<btMultiBodyJointLimitConstraint>> limits_;
  btAlignedObjectArray<btQuaternion> rotations_;  // scratch memory for Bullet
  btAlignedObjectArray<btVector3> origins_;
};

}  // namespace octoblisk::demos
