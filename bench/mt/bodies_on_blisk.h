// Bodies, convex and concave, that fall onto the blisk: in btDiscreteDynamicsWorld, or in
// btDiscreteDynamicsWorldMt on the threads of Bullet's task scheduler. Units: millimetres.
#pragma once

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorldMt.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "dynamics/kept_shapes.h"

namespace octoblisk::bench {

/// Gives Bullet's task scheduler this number of threads, whatever the number of processors. A parallel world
/// runs only on as many as when it was made.
void useThreads(int threads);

enum class WorldKind { plain, parallel };

class BodiesOnBlisk {
 public:
  /// `shapes`: `octoblisk`, or `bvh`: then the blisk is a btBvhTriangleMeshShape and each concave body a
  /// compound of its convex pieces.
  BodiesOnBlisk(WorldKind world, ShapeKind shapes, int bodies,
                std::unique_ptr<btBroadphaseInterface> broadphase = std::make_unique<btDbvtBroadphase>());
  ~BodiesOnBlisk();
  BodiesOnBlisk(const BodiesOnBlisk&) = delete;
  BodiesOnBlisk& operator=(const BodiesOnBlisk&) = delete;

  void step() { world_->stepSimulation(btScalar(1.0 / 240.0), 0); }
  /// The number of bodies below the floor or beyond the walls.
  int lost() const;

  btDiscreteDynamicsWorld& world() { return *world_; }
  btDefaultCollisionConfiguration& configuration() { return configuration_; }
  /// The bodies that move. Every second one is concave. None of them sleeps.
  const std::vector<std::unique_ptr<btRigidBody>>& moving() const { return moving_; }

 private:
  struct Kind {
    btCollisionShape* shape;
    btVector3 inertia;
  };

  Kind convex(btCollisionShape& shape) const;
  Kind concave(ShapeKind shapes, const Solid& solid);
  btRigidBody& add(std::vector<std::unique_ptr<btRigidBody>>& bodies, const Kind& kind, btScalar mass,
                   const btTransform& pose);

  btDefaultCollisionConfiguration configuration_;
  std::unique_ptr<btCollisionDispatcher> dispatcher_;
  std::unique_ptr<btBroadphaseInterface> broadphase_;
  std::unique_ptr<btConstraintSolver> solver_, solver_of_large_islands_;
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
  KeptShapes shapes_;
  std::vector<std::unique_ptr<btRigidBody>> fixed_, moving_;
};

}  // namespace octoblisk::bench
