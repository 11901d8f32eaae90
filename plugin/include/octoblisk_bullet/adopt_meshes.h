// Gives the bodies of a whole world ClusteredOctreeShape, for example after a loader has made it.
#pragma once

#include <LinearMath/btScalar.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "octoblisk/build_options.h"

class btCollisionShape;
class btCollisionWorld;
class btRigidBody;

namespace octoblisk {

class ClusteredOctreeShape;

/// The shapes that adoptMeshes replaced. Owns the new shapes, so it must outlive the bodies that use them, or
/// putBack must be called first. The replaced shapes still belong to whoever made them.
class AdoptedMeshes {
 public:
  struct Replaced {
    btCollisionShape* before;
    ClusteredOctreeShape* now;
  };
  /// A mesh that was not replaced, or a body that did not become dynamic, and the reason in words.
  struct Left {
    btCollisionShape* shape;
    std::string why;
  };

  AdoptedMeshes(AdoptedMeshes&&) noexcept;
  AdoptedMeshes& operator=(AdoptedMeshes&&) noexcept;
  ~AdoptedMeshes();

  const std::vector<Replaced>& replaced() const;
  const std::vector<Left>& left() const;

  /// Gives all bodies that are still in the world their former shapes, and bodies whose mass or inertia
  /// changed their former mass and inertia. The world and the former shapes must exist. The algorithms stay
  /// registered. Does nothing if called again.
  void putBack();

 private:
  friend AdoptedMeshes adoptMeshes(btCollisionWorld&, const std::function<btScalar(const btRigidBody&)>&,
                                   const BuildOptions&);
  class Adoption;
  explicit AdoptedMeshes(std::unique_ptr<Adoption> adoption);
  std::unique_ptr<Adoption> adoption_;
};

/// Replaces the meshes of all collision objects in a world, also in compounds and on links of multibodies, by
/// ClusteredOctreeShape over the same triangles: btBvhTriangleMeshShape, btScaledBvhTriangleMeshShape and
/// btGImpactMeshShape. Calls registerAlgorithm (register.h) on the world's dispatcher, which must be a
/// btCollisionDispatcher. If the program uses GImpact's algorithm, register that first.
///
/// A new shape has the scaling, the user pointer and the user indices of the old one, and its margin unless
/// that is 0, Bullet's default. Shapes over the same mesh interface with the same scaling share one tree.
/// Children are replaced within their compound, which may also be used elsewhere. Poses, masses, friction,
/// filters and names stay. A rigid body that has the inertia that its old mesh computes gets the exact
/// inertia of the new one.
///
/// `mass_of` returns the mass of a static rigid body that is to be dynamic, and 0 for others. It is called
/// for the static bodies of a btDynamicsWorld with replaced meshes. The body's origin becomes its centre of
/// mass. If it has the filters of static bodies, it gets those of dynamic ones.
///
/// Left as they are: btMultimaterialTriangleMeshShape, whose callbacks need that type, GImpact compounds,
/// and meshes that ClusteredOctreeShape refuses. Changes nothing if it throws. Do not call it during a step.
AdoptedMeshes adoptMeshes(btCollisionWorld& world,
                          const std::function<btScalar(const btRigidBody&)>& mass_of = {},
                          const BuildOptions& options = {});

}  // namespace octoblisk
