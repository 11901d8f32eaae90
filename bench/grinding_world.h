// The world that a broadphase is judged in: a blisk, the belt grinder driven along a path over one of its
// blades, and loose bodies near the hub and between the blades. Lengths in mm, times in s.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <string>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_shape.h"

namespace octoblisk::bench {

/// What is in the world, and where the tool goes.
struct GrindingScene {
  std::string name;
  std::shared_ptr<const ClusteredOctree> blisk;
  std::vector<int> blade_of_triangle;                        ///< 1..; 0 for the hub
  std::vector<std::shared_ptr<const ClusteredOctree>> tool;  ///< belt, wheels, arm
  std::vector<Pose> tool_in_blisk;                           ///< one a step
  std::vector<Pose> loose;                                   ///< of the loose bodies

  static constexpr double kTimeStep = 1.0 / 240.0;
  static constexpr double kFeed = 100.0;  ///< of the tool, mm/s
};

/// The default path over blade 1, there and back, and 200 loose bodies at rest that touch neither blisk nor
/// tool nor each other: 80 within the hub's radius, 120 between the blades. Throws std::invalid_argument
/// where no blades are found.
GrindingScene makeGrindingScene(std::string name, TriangleMesh blisk);

/// How the blisk is held. No solver moves a static or kinematic body; a dynamic one shares its island with
/// all that it has a pair with.
enum class Mount {
  clamped,  ///< static
  table,    ///< kinematic, on a table that stands still
  spindle,  ///< dynamic, on a hinge that a motor holds
};

/// Without gravity, so that what is between the blades stays there.
class GrindingWorld {
 public:
  GrindingWorld(const GrindingScene& scene, Mount mount, btBroadphaseInterface& broadphase);
  ~GrindingWorld();
  GrindingWorld(const GrindingWorld&) = delete;
  GrindingWorld& operator=(const GrindingWorld&) = delete;

  /// Moves the tool there, and the world on by a step.
  void step(const Pose& tool_in_blisk);

  int pairs();                 ///< that Bullet is told of
  int toolContacts();          ///< contact points of tool and blisk
  double bliskTurned() const;  ///< from how it was mounted, degrees
  int awakeBodies() const;     ///< dynamic ones
  int awakeIslands() const;    ///< that these are of

 private:
  btRigidBody& addDynamic(btCollisionShape& shape, btScalar mass, const Pose& pose);

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btBroadphaseInterface& broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  ClusteredOctreeShape blisk_shape_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;  // the blisk, the tool's parts, the loose ones
  std::size_t tool_parts_;
  std::unique_ptr<btTypedConstraint> hinge_;
};

}  // namespace octoblisk::bench
