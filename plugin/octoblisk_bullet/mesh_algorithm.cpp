#include "octoblisk_bullet/mesh_algorithm.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>

#include <optional>

#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk {
namespace {

/// One body of a contact as Bullet wants to be told of it: where it is our shape, by part and triangle, with
/// the triangle itself as the shape that gContactAddedCallback sees.
class ContactSide {
 public:
  ContactSide(const btCollisionObjectWrapper& body, std::uint32_t triangle) {
    const auto* shape =
        triangle == kNoTriangle ? nullptr : static_cast<const ClusteredOctreeShape*>(body.m_shape);
    if (!shape) return;
    id_ = shape->triangleId(triangle);
    const Triangle corners = shape->tree().mesh().triangle(triangle);
    triangle_.emplace(toBullet(corners[0]), toBullet(corners[1]), toBullet(corners[2]));
    triangle_->setMargin(shape->getMargin());
    wrap_.emplace(&body, &*triangle_, body.getCollisionObject(), body.getWorldTransform(), id_.part,
                  id_.index);
  }

  const TriangleId& id() const { return id_; }
  const btCollisionObjectWrapper* wrapOr(const btCollisionObjectWrapper* body) const {
    return wrap_ ? &*wrap_ : body;
  }

 private:
  TriangleId id_ = {-1, -1};
  std::optional<btTriangleShape> triangle_;
  std::optional<btCollisionObjectWrapper> wrap_;
};

/// The thickness that a shape has beyond its contacts: a concave shape's margin; a convex one's is in them.
double marginBeyondSurface(const btCollisionObjectWrapper& body) {
  return body.m_shape->isConcave() ? double(body.m_shape->getMargin()) : 0.0;
}

}  // namespace

MeshAlgorithm::MeshAlgorithm(const btCollisionAlgorithmConstructionInfo& info,
                             const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                             bool mesh_is_body1)
    : btActivatingCollisionAlgorithm(info, body0, body1),
      mesh_is_body1_(mesh_is_body1),
      manifolds_(*info.m_dispatcher1, body0->getCollisionObject(), body1->getCollisionObject()) {}

void MeshAlgorithm::processCollision(const btCollisionObjectWrapper* body0,
                                     const btCollisionObjectWrapper* body1, const btDispatcherInfo&,
                                     btManifoldResult* result) {
  const btCollisionObjectWrapper& mesh = mesh_is_body1_ ? *body1 : *body0;
  const btCollisionObjectWrapper& other = mesh_is_body1_ ? *body0 : *body1;
  const double mesh_margin = marginBeyondSurface(mesh), other_margin = marginBeyondSurface(other);
  const double reach = double(manifolds_.at(0)->getContactBreakingThreshold()) +
                       double(result->m_closestPointDistanceThreshold) + mesh_margin + other_margin;
  findContacts(mesh, other, reach, contacts_);

  const Pose mesh_in_world = fromBullet(mesh.getWorldTransform());
  std::size_t patch_index = 0;
  for (const ContactPatch& patch : patches_.reduce(contacts_)) {
    result->setPersistentManifold(manifolds_.at(patch_index++));
    for (const Contact& contact : patch.points()) {
      const Vec3 to_mesh = mesh_in_world.rotation * contact.normal;
      const Vec3 on_mesh = mesh_in_world * contact.point_on_a - mesh_margin * to_mesh;
      const Vec3 on_other = mesh_in_world * contact.point_on_b + other_margin * to_mesh;
      const ContactSide mesh_side(mesh, contact.triangle_a), other_side(other, contact.triangle_b);
      const ContactSide& side0 = mesh_is_body1_ ? other_side : mesh_side;
      const ContactSide& side1 = mesh_is_body1_ ? mesh_side : other_side;

      result->setShapeIdentifiersA(side0.id().part, side0.id().index);
      result->setShapeIdentifiersB(side1.id().part, side1.id().index);
      result->setBody0Wrap(side0.wrapOr(body0));
      result->setBody1Wrap(side1.wrapOr(body1));
      // Bullet's normal is on body 1 and points to body 0.
      result->addContactPoint(toBullet(mesh_is_body1_ ? Vec3(-to_mesh) : to_mesh),
                              toBullet(mesh_is_body1_ ? on_mesh : on_other),
                              btScalar(contact.distance - mesh_margin - other_margin));
      result->setBody0Wrap(body0);
      result->setBody1Wrap(body1);
    }
  }
  for (std::size_t i = 0; i < manifolds_.size(); ++i) {
    result->setPersistentManifold(manifolds_.at(i));
    result->refreshContactPoints();
  }
}

}  // namespace octoblisk
