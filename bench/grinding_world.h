// The world in which broadphases are compared: a blisk, the belt grinder driven along a path over one of its
// blades, and loose bodies near the hub and between the blades. Units: mm and s.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <string>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_shape.h"

namespace octoblisk::bench {

/// The contents of the world and the toolpath.
struct GrindingScene {
  std::string name;
  std::shared_ptr<const ClusteredOctree> blisk;
  std::vector<int> blade_of_triangle;                        ///< from 1; 0 for the hub
  std::vector<std::shared_ptr<const ClusteredOctree>> tool;  ///< belt, wheels, arm
  std::vector<Pose> tool_in_blisk;                           ///< one for each step
  std::vector<Pose> loose;                                   ///< of the loose bodies

  static constexpr double kTimeStep = 1.0 / 240.0;
  static constexpr double kFeed = 100.0;  ///< of the tool, mm/s
};

/// The default path over blade 1, there and back, with 200 loose bodies at rest: 80 within the hub's radius
/// and 120 between the blades. They touch neither the blisk, the tool nor each other. Throws
/// std::invalid_argument if no blades are found.
GrindingScene makeGrindingScene(std::string name, TriangleMesh blisk);

/// How the blisk is held. No solver moves a static or kinematic body; a dynamic one shares an island with
/// every body it has a pair with.
enum class Mount {
  clamped,  ///< static
  table,    ///< kinematic, on a table at rest
  spindle,  ///< dynamic, on a hinge held by a motor
};

/// Has no gravity, so bodies between the blades stay there.
class GrindingWorld {
 public:
  GrindingWorld(const GrindingScene& scene, Mount mount, btBroadphaseInterface& broadphase);
  ~GrindingWorld();
  GrindingWorld(const GrindingWorld&) = delete;
  GrindingWorld& operator=(const GrindingWorld&) = delete;

  /// Moves the tool to the pose and advances the world by one step.
  void step(const Pose& tool_in_blisk);

  int pairs();                 ///< that the broadphase reports to Bullet
  int toolContacts();          ///< contact points of tool and blisk
  double bliskTurned() const;  ///< from its mounted orientation, degrees
  int awakeBodies() const;     ///< dynamic bodies only
  int awakeIslands() const;    ///< of these bodies

 private:
  btRigidBody& addDynamic(btCollisionShape& shape, btScalar mass, const Pose& pose);

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btBroadphaseInterface& broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  ClusteredOctreeShape blisk_shape_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;  // the blisk, the tool's parts, the loose bodies
  std::size_t tool_parts_;
  std::unique_ptr<btTypedConstraint> hinge_;
};

}  // namespace octoblisk::bench
