// What the algorithms of our shape have in common: from contacts of the core to points of Bullet's manifolds.
#pragma once

#include <BulletCollision/CollisionDispatch/btActivatingCollisionAlgorithm.h>

#include <memory>
#include <optional>
#include <typeindex>
#include <vector>

#include "contact/contact_patches.h"
#include "manifolds.h"
#include "octoblisk/triangle_source.h"

struct btCollisionObjectWrapper;

namespace octoblisk {
class ClusteredOctree;
class ClusteredOctreeShape;
}  // namespace octoblisk

namespace octoblisk::detail {

/// A triangle of our shape, in its frame, as Bullet numbers it.
SourceTriangle triangleOf(const ClusteredOctreeShape& shape, std::uint32_t triangle);

/// The algorithm of a pair of bodies. One body, the mesh, has our shape. If setCollisionShape gives a body a
/// shape of another type later, the dispatcher's algorithm for these shapes answers.
class MeshAlgorithm : public btActivatingCollisionAlgorithm {
 public:
  void processCollision(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                        const btDispatcherInfo& info, btManifoldResult* result) final;
  void getAllContactManifolds(btManifoldArray& array) final {
    manifolds_.appendTo(array);
    if (substitute_) substitute_->getAllContactManifolds(array);
  }

  /// Discrete: the whole step is free.
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) final {
    return 1;
  }

 protected:
  /// `mesh_is_body1`: the pair comes in the order (other, mesh).
  MeshAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* body0,
                const btCollisionObjectWrapper* body1, bool mesh_is_body1);

 private:
  /// The types of the two bodies' shapes.
  struct ShapeTypes {
    std::type_index of0, of1;
    ShapeTypes(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);
    bool operator==(const ShapeTypes&) const = default;
  };

  struct AlgorithmDeleter {
    btDispatcher* dispatcher;
    void operator()(btCollisionAlgorithm* algorithm) const;
  };

  /// The algorithm that the dispatcher has for shapes that were exchanged in place.
  btCollisionAlgorithm& substituteFor(const ShapeTypes& types, const btCollisionObjectWrapper& body0,
                                      const btCollisionObjectWrapper& body1);

  /// Replaces `found` by the contacts of the triangles of mesh (A) and other (B) within `reach`, in the
  /// mesh's frame.
  virtual void findContacts(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other,
                            double reach, std::vector<Contact>& found) = 0;

  /// Makes of the contacts that were found last those of the surfaces, which know no edges between triangles.
  virtual void toSurfaceContacts(const btCollisionObjectWrapper&, const btCollisionObjectWrapper&, double,
                                 std::vector<Contact>&) {}

  /// Nothing that is known of the shapes' triangles holds any more.
  virtual void trianglesHaveMoved() {}

  /// Reads the other's shape; returns whether it is surely as it was at the last call, its tree apart. Called
  /// first.
  virtual bool readOther(const btCollisionObjectWrapper& other) = 0;

  /// The thickness that the other body has beyond the surface of those contacts.
  virtual double marginOfOther(const btCollisionObjectWrapper&) const { return 0.0; }

  /// The other's triangle, in its frame, in a contact that was found last: none where it is not of triangles.
  virtual std::optional<SourceTriangle> triangleOfOther(const btCollisionObjectWrapper&,
                                                        const Contact&) const {
    return std::nullopt;
  }

  /// Makes patches_ of the contacts within `reach`, `spacing` apart, at the present poses.
  void makePatches(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other, double reach,
                   double spacing);

  const bool mesh_is_body1_;
  const ShapeTypes types_;
  ShapeTypes substitute_types_;
  std::unique_ptr<btCollisionAlgorithm, AlgorithmDeleter> substitute_;  // while other shapes are met
  Manifolds manifolds_;
  std::shared_ptr<const ClusteredOctree> tree_, tree_of_other_;  // that the contacts are of
  std::vector<Contact> contacts_;
  ContactPatches patches_;
  std::optional<Pose> other_in_mesh_;  // when the patches were made
  double reach_ = 0.0;                 // likewise
  bool is_solid_ = false;              // the mesh, likewise
};

}  // namespace octoblisk::detail
