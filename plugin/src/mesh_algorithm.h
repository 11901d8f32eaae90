// The common part of this library's collision algorithms: from contacts of the core to points of Bullet's
// manifolds.
#pragma once

#include <BulletCollision/CollisionDispatch/btActivatingCollisionAlgorithm.h>

#include <memory>
#include <optional>
#include <typeindex>
#include <vector>

#include "contact/contact_patches.h"
#include "contact/way_back.h"
#include "manifolds.h"
#include "octoblisk/triangle_source.h"

class btCollisionShape;
struct btCollisionObjectWrapper;

namespace octoblisk {
class ClusteredOctree;
class ClusteredOctreeShape;
}  // namespace octoblisk

namespace octoblisk::detail {

/// The triangle of a ClusteredOctreeShape that a triangle of its solid's boundary belongs to, in the shape's
/// frame, with Bullet's numbers.
SourceTriangle triangleOf(const ClusteredOctreeShape& shape, std::uint32_t boundary_triangle);

struct AlgorithmDeleter {
  btDispatcher* dispatcher;
  void operator()(btCollisionAlgorithm* algorithm) const {
    algorithm->~btCollisionAlgorithm();
    dispatcher->freeCollisionAlgorithm(algorithm);
  }
};
/// An algorithm of a dispatcher's pool.
using OwnedAlgorithm = std::unique_ptr<btCollisionAlgorithm, AlgorithmDeleter>;

/// What setSolid changes.
struct Solidity {
  bool is_solid = false, is_anywhere_solid = false;
  const ClusteredOctree* boundary = nullptr;
  bool operator==(const Solidity&) const = default;
};

/// The algorithm of a pair of bodies. One of them, the mesh, has a ClusteredOctreeShape. If setCollisionShape
/// later gives a body a shape of another type, the dispatcher's algorithm for the new types takes over.
class MeshAlgorithm : public btActivatingCollisionAlgorithm {
 public:
  /// `mesh_is_body1`: the order of the pair is (other, mesh).
  MeshAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* body0,
                const btCollisionObjectWrapper* body1, bool mesh_is_body1 = false);

  void processCollision(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                        const btDispatcherInfo& info, btManifoldResult* result) final;
  void getAllContactManifolds(btManifoldArray& array) final {
    manifolds_.appendTo(array);
    if (substitute_) substitute_->getAllContactManifolds(array);
  }

  /// Collision detection is discrete, so the whole step is free.
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) final {
    return 1;
  }

 protected:
  /// Contacts are created within this fraction of the contact breaking threshold.
  static constexpr double kCreated = 0.5;

  /// The shapes of the two bodies, the other body's pose in the mesh's frame, and the contact breaking
  /// threshold of the pair.
  struct PosedShapes {
    const ClusteredOctreeShape& mesh;
    const btCollisionShape& other;
    Pose other_in_mesh;
    double breaking;
    double reach;                    ///< within which contacts are sought
    bool has_all_triangles = false;  ///< also those that a body cannot touch from outside
    std::optional<Pose> other_when_apart = std::nullopt;  ///< in the mesh's frame, if known

    const ClusteredOctree& treeOf(const ClusteredOctreeShape& shape) const;
    const ClusteredOctree& treeOfMesh() const { return treeOf(mesh); }
  };

 private:
  /// The types of the two bodies' shapes.
  struct ShapeTypes {
    std::type_index of0, of1;
    ShapeTypes(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);
    bool operator==(const ShapeTypes&) const = default;
  };

  /// The dispatcher's algorithm for shapes that replaced the original ones.
  btCollisionAlgorithm& substituteFor(const ShapeTypes& types, const btCollisionObjectWrapper& body0,
                                      const btCollisionObjectWrapper& body1);

  /// Replaces `found` with the contacts between the triangles of the mesh (A) and the other body (B) within
  /// reach, in the mesh's frame. AllContacts reports these for all triangles.
  virtual void findTriangleContacts(const PosedShapes& shapes, std::vector<Contact>& found) = 0;

  /// The same of the bodies: without contacts that exist only because surfaces are divided into triangles.
  /// Steps and contact tests use these.
  virtual void findBodyContacts(const PosedShapes& shapes, std::vector<Contact>& found) {
    findTriangleContacts(shapes, found);
  }

  /// Discards everything that is known about the shapes' triangles.
  virtual void trianglesHaveMoved() {}

  /// Reads the other body's shape, as far as it is within reach. Returns whether that is certainly unchanged
  /// since the last call, apart from the shape's tree. Called first.
  virtual bool readOther(const PosedShapes& shapes) = 0;

  /// The margin of the other body that findTriangleContacts does not include.
  virtual double marginOfOther(const btCollisionShape&) const { return 0.0; }

  /// The other body, if it is convex.
  virtual std::optional<WayBack::ConvexBody> convexOther() { return std::nullopt; }

  /// The other body's triangle, in its frame, in a contact that was found last; none if the body has no
  /// triangles.
  virtual std::optional<SourceTriangle> triangleOfOther(const btCollisionShape&, const Contact&) const {
    return std::nullopt;
  }

  /// Discards what was made with earlier states of the shapes.
  void noticeChanges(const PosedShapes& shapes);

  /// Where the two bodies were at the start of a step, and its length.
  struct Step {
    Pose mesh_in_world, other_in_world;
    btScalar length;
  };

  /// Whether contacts may pull a body through an open mesh.
  bool mayPull(const btCollisionShape& other) const;

  /// After findBodyContacts: keeps the contacts from pulling a body through an open mesh. If
  /// the last step is unknown, assumes that it took `time_step`.
  void pushBack(PosedShapes& shapes, const btCollisionObjectWrapper& mesh,
                const btCollisionObjectWrapper& other, btScalar time_step);

  /// Measures the room if one body is between opposite walls of the other. Keeps the greatest room since the
  /// bodies met: a load shrinks the room, and the margins would shrink with it.
  void noticeRoom();

  /// Passes the points of the patches to Bullet at the current poses.
  void showPatches(const PosedShapes& shapes, const btCollisionObjectWrapper& mesh,
                   const btCollisionObjectWrapper& other, btScalar time_step, btManifoldResult& result);

  const bool mesh_is_body1_;
  const ShapeTypes types_;
  ShapeTypes substitute_types_;
  OwnedAlgorithm substitute_;  // for other types of shapes
  Manifolds manifolds_;
  std::shared_ptr<const ClusteredOctree> tree_, tree_of_other_;  // the trees of the current contacts
  std::vector<Contact> contacts_;
  WayBack way_back_;               // if a body has an open mesh
  std::optional<Step> last_step_;  // if a body has an open mesh
  ContactPatches patches_;

  // The state for which the patches were made. Without a pose, they are made anew.
  std::optional<Pose> other_in_mesh_;
  double reach_ = 0.0;
  std::optional<double> room_;               // between opposite walls; limits the margins of this pair
  std::pair<Solidity, Solidity> are_solid_;  // the mesh, and the other body's mesh
};

}  // namespace octoblisk::detail
