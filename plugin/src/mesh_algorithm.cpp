#include "mesh_algorithm.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>

#include <algorithm>
#include <optional>
#include <span>

#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/all_contacts.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk::detail {
namespace {

/// One body of a contact as Bullet wants to be told of it: a mesh by part and triangle, with the triangle
/// itself as the shape that gContactAddedCallback sees; any other as it came, by its place in a compound,
/// say.
class ContactSide {
 public:
  ContactSide(const btCollisionObjectWrapper& body, const std::optional<SourceTriangle>& triangle)
      : body_(body), part_(body.m_partId), index_(body.m_index) {
    if (!triangle) return;
    part_ = triangle->part;
    index_ = triangle->index;
    const auto& [first, second, third] = triangle->corners;
    triangle_.emplace(toBullet(first), toBullet(second), toBullet(third));
    triangle_->setMargin(body.m_shape->getMargin());
    wrap_.emplace(&body, &*triangle_, body.getCollisionObject(), body.getWorldTransform(), part_, index_);
  }

  int part() const { return part_; }
  int index() const { return index_; }
  const btCollisionObjectWrapper* wrap() const { return wrap_ ? &*wrap_ : &body_; }

 private:
  const btCollisionObjectWrapper& body_;
  int part_, index_;
  std::optional<btTriangleShape> triangle_;
  std::optional<btCollisionObjectWrapper> wrap_;
};

/// Shows a result the two sides of a contact, then what it saw before. A compound may ask for its child's
/// pair in the other order than its result is in.
class ShownSides {
 public:
  ShownSides(btManifoldResult& result, const btCollisionObject* body0, const ContactSide& side0,
             const ContactSide& side1)
      : result_(result), wrap0_(result.getBody0Wrap()), wrap1_(result.getBody1Wrap()) {
    const bool in_order = wrap0_->getCollisionObject() == body0;
    const ContactSide &first = in_order ? side0 : side1, &second = in_order ? side1 : side0;
    result_.setShapeIdentifiersA(first.part(), first.index());
    result_.setShapeIdentifiersB(second.part(), second.index());
    result_.setBody0Wrap(first.wrap());
    result_.setBody1Wrap(second.wrap());
  }
  ~ShownSides() {
    result_.setBody0Wrap(wrap0_);
    result_.setBody1Wrap(wrap1_);
  }
  ShownSides(const ShownSides&) = delete;
  ShownSides& operator=(const ShownSides&) = delete;

 private:
  btManifoldResult& result_;
  const btCollisionObjectWrapper* wrap0_;
  const btCollisionObjectWrapper* wrap1_;
};

/// As Bullet computes it for a new manifold, from the root shapes, and no more than the mesh's own, which
/// may be a compound's child.
double breakingThreshold(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other) {
  const auto of = [](const btCollisionShape* shape) {
    return double(shape->getContactBreakingThreshold(gContactBreakingThreshold));
  };
  return std::min({of(mesh.getCollisionObject()->getCollisionShape()),
                   of(other.getCollisionObject()->getCollisionShape()), of(mesh.m_shape)});
}

/// 0 for shapes that have none.
std::uint32_t revision(const btCollisionObjectWrapper& body) {
  const auto* shape = dynamic_cast<const ClusteredOctreeShape*>(body.m_shape);
  return shape ? shape->revision() : 0;
}

}  // namespace

SourceTriangle triangleOf(const ClusteredOctreeShape& shape, std::uint32_t triangle) {
  const TriangleId id = shape.triangleId(triangle);
  return {shape.tree().mesh().triangle(triangle), id.part, id.index};
}

MeshAlgorithm::ShapeTypes::ShapeTypes(const btCollisionObjectWrapper& body0,
                                      const btCollisionObjectWrapper& body1)
    : of0(typeid(*body0.m_shape)), of1(typeid(*body1.m_shape)) {}

MeshAlgorithm::MeshAlgorithm(const btCollisionAlgorithmConstructionInfo& info,
                             const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                             bool mesh_is_body1)
    : btActivatingCollisionAlgorithm(info, body0, body1),
      mesh_is_body1_(mesh_is_body1),
      types_(*body0, *body1),
      substitute_types_(types_),
      substitute_(nullptr, {info.m_dispatcher1}),
      manifolds_(*info.m_dispatcher1, body0->getCollisionObject(), body1->getCollisionObject()) {}

void MeshAlgorithm::AlgorithmDeleter::operator()(btCollisionAlgorithm* algorithm) const {
  algorithm->~btCollisionAlgorithm();
  dispatcher->freeCollisionAlgorithm(algorithm);
}

btCollisionAlgorithm& MeshAlgorithm::substituteFor(const ShapeTypes& types,
                                                   const btCollisionObjectWrapper& body0,
                                                   const btCollisionObjectWrapper& body1) {
  if (!substitute_ || substitute_types_ != types) {
    substitute_.reset(m_dispatcher->findAlgorithm(&body0, &body1, nullptr, BT_CONTACT_POINT_ALGORITHMS));
    substitute_types_ = types;
  }
  return *substitute_;
}

void MeshAlgorithm::processCollision(const btCollisionObjectWrapper* body0,
                                     const btCollisionObjectWrapper* body1, const btDispatcherInfo& info,
                                     btManifoldResult* result) {
  if (const ShapeTypes types(*body0, *body1); types != types_) {
    manifolds_.clear();
    substituteFor(types, *body0, *body1).processCollision(body0, body1, info, result);
    return;
  }
  substitute_.reset();
  const btCollisionObjectWrapper& mesh = mesh_is_body1_ ? *body1 : *body0;
  const btCollisionObjectWrapper& other = mesh_is_body1_ ? *body0 : *body1;
  const auto& shape = static_cast<const ClusteredOctreeShape&>(*mesh.m_shape);
  const double mesh_margin = double(shape.getMargin()), other_margin = marginOfOther(other);
  const double breaking = breakingThreshold(mesh, other);
  const double reach =
      breaking + double(result->m_closestPointDistanceThreshold) + mesh_margin + other_margin;
  const std::uint32_t revisions = revision(mesh) + revision(other);
  if (revisions != revisions_) {
    manifolds_.clear();
    trianglesHaveMoved();
  }
  revisions_ = revisions;
  findContacts(mesh, other, reach, contacts_);
  if (auto* const all = dynamic_cast<AllContacts*>(result)) {
    all->take(*mesh.getCollisionObject(), contacts_);
    return;
  }
  toSurfaceContacts(mesh, other, reach, contacts_);

  const Pose mesh_in_world = fromBullet(mesh.getWorldTransform());
  const std::span<const ContactPatch> patches = patches_.reduce(contacts_);
  manifolds_.match(patches, mesh_in_world, mesh_is_body1_, btScalar(breaking));
  for (std::size_t p = 0; p < patches.size(); ++p) {
    btPersistentManifold* const manifold = manifolds_.of(p);
    if (!manifold) break;  // the pool is exhausted: the contacts are dropped, as Bullet does
    result->setPersistentManifold(manifold);
    // Points that have slid away go first: in a full manifold they would take the place of new ones.
    result->refreshContactPoints();
    // The deepest last, as a point takes the place of one that is close to it.
    const std::span<const Contact> points = patches[p].points();
    for (auto point = points.rbegin(); point != points.rend(); ++point) {
      const Contact& contact = *point;
      const Vec3 to_mesh = mesh_in_world.rotation * contact.normal;
      const Vec3 on_mesh = mesh_in_world * contact.point_on_a - mesh_margin * to_mesh;
      const Vec3 on_other = mesh_in_world * contact.point_on_b + other_margin * to_mesh;
      const ContactSide mesh_side(mesh, triangleOf(shape, contact.triangle_a));
      const ContactSide other_side(other, triangleOfOther(other, contact));
      const ShownSides shown(*result, body0->getCollisionObject(), mesh_is_body1_ ? other_side : mesh_side,
                             mesh_is_body1_ ? mesh_side : other_side);
      // Bullet's normal is on body 1 and points to body 0.
      result->addContactPoint(toBullet(mesh_is_body1_ ? Vec3(-to_mesh) : to_mesh),
                              toBullet(mesh_is_body1_ ? on_mesh : on_other),
                              btScalar(contact.distance - mesh_margin - other_margin));
    }
    result->refreshContactPoints();
  }
  // Bullet wants one even where nothing touches.
  if (patches.empty()) result->setPersistentManifold(manifolds_.any());
}

}  // namespace octoblisk::detail
