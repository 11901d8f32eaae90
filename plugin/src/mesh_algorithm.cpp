#include "mesh_algorithm.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>

#include <algorithm>
#include <optional>
#include <span>
#include <type_traits>
#include <typeinfo>
#include <utility>

#include "contact/solid_mesh.h"
#include "octoblisk/body_bounds.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/raycast.h"
#include "octoblisk_bullet/all_contacts.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "our_shape.h"
#include "shape_bounds.h"
#include "step_correction.h"
#include "step_start.h"

namespace octoblisk::detail {
namespace {

/// Bodies that have moved less than this fraction of the contact breaking threshold keep their contacts.
constexpr double kStill = 0.2;

/// Between opposite walls, the margins on each side take at most this fraction of the room, so that a body
/// can slide.
constexpr double kTaken = 0.4;

/// One body of a contact in the form that Bullet expects. A mesh is identified by part and triangle, and
/// gContactAddedCallback sees the triangle itself as the shape. Any other body keeps its identifiers, e.g.
/// its index in a compound.
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

/// Gives a result the two sides of a contact, and restores its previous bodies at the end. A compound may ask
/// for its child's pair in the opposite order of its result.
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

/// The pose of a body, or of a child of its shape, at the start of the last step, which took `time_step`.
/// `before` is its pose before that step; null if unknown.
Pose startOf(const btCollisionObjectWrapper& body, btScalar time_step, const Pose* before) {
  const btCollisionObject& object = *body.getCollisionObject();
  const bool has_velocity =
      !object.getInterpolationLinearVelocity().isZero() || !object.getInterpolationAngularVelocity().isZero();
  // Bullet moves a kinematic body before the first step of a frame, by the way of the whole frame.
  if (before && object.isKinematicObject() && has_velocity) return *before;
  const Pose in_object =
      fromBullet(object.getWorldTransform()).inverse() * fromBullet(body.getWorldTransform());
  return fromBullet(stepStart(object, time_step)) * in_object;
}

/// Whether the touching points of the two bodies have certainly moved by at most `limit` relative to each
/// other.
bool areStill(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other, const Pose& from,
              const Pose& to, double limit) {
  const auto displacement = [](const btCollisionObjectWrapper& body, const Pose& before, const Pose& after) {
    return BodyBounds(shapeBounds(*body.m_shape)).displacement(before, after);
  };
  return displacement(other, from, to) <= limit || displacement(mesh, from.inverse(), to.inverse()) <= limit;
}

/// A contact of A and B after B has moved in A's frame, and its origin by `shift_of_b`. The smaller body may
/// roll on the other: the place of touch moves along with its centre, but does not turn with it.
Contact afterMotion(Contact contact, const Pose& motion_of_b, const Vec3& shift_of_b) {
  const Vec3 if_a_rolls = motion_of_b.rotation * contact.point_on_a - contact.point_on_a;
  const Vec3 shift = shift_of_b.norm() < if_a_rolls.norm() ? shift_of_b : if_a_rolls;
  contact.distance = (contact.point_on_a - motion_of_b * contact.point_on_b).dot(contact.normal);
  contact.point_on_a += shift - shift.dot(contact.normal) * contact.normal;
  contact.point_on_b = contact.point_on_a - contact.distance * contact.normal;
  return contact;
}

/// How far one body can move between contacts with the other whose normals are nearly opposite. None if there
/// are no such contacts, or if it is squeezed between them.
std::optional<double> roomBetween(std::span<const ContactPatch> patches) {
  constexpr double kOpposed = -0.96;  // within 16° of opposite: walls that converge more carry the body
  std::optional<double> room;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    for (std::size_t q = p + 1; q < patches.size(); ++q) {
      for (const Contact& first : patches[p].points()) {
        for (const Contact& second : patches[q].points()) {
          if (first.normal.dot(second.normal) > kOpposed) continue;
          const double between = first.distance + second.distance;
          if (between <= 0.0) return std::nullopt;
          room = std::min(room.value_or(between), between);
        }
      }
    }
  }
  return room;
}

/// The rounding of a point between the two bodies, when Bullet converts it from the world to a body and back.
btScalar roundingBetween(const btCollisionObjectWrapper& mesh, const btCollisionObjectWrapper& other,
                         const Aabb& mesh_bounds) {
  const double farthest = double(mesh.getWorldTransform().getOrigin().length()) +
                          double(other.getWorldTransform().getOrigin().length()) +
                          mesh_bounds.farthestFromOrigin();
  return 8 * SIMD_EPSILON * btScalar(farthest);
}

/// Keeps the tree of a shape, if any, and returns whether the tree has changed. Keeping the tree alive
/// prevents a new tree from getting its address.
bool keepTree(const ClusteredOctreeShape* shape, std::shared_ptr<const ClusteredOctree>& kept) {
  if ((shape ? &shape->tree() : nullptr) == kept.get()) return false;
  kept = shape ? shape->sharedTree() : nullptr;
  return true;
}

Solidity solidityOf(const ClusteredOctreeShape* mesh) {
  if (!mesh) return {};
  const SolidMesh solid = mesh->solid();
  return {mesh->isSolid(), solid.isAnywhereSolid(), &solid.boundary()};
}

}  // namespace

const ClusteredOctree& MeshAlgorithm::PosedShapes::treeOf(const ClusteredOctreeShape& shape) const {
  return has_all_triangles ? shape.tree() : shape.solid().boundary();
}

SourceTriangle triangleOf(const ClusteredOctreeShape& shape, std::uint32_t boundary_triangle) {
  const std::uint32_t triangle = shape.solid().sourceOf(boundary_triangle);
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
    way_back_.forget();
    last_step_.reset();
    substituteFor(types, *body0, *body1).processCollision(body0, body1, info, result);
    return;
  }
  substitute_.reset();
  const btCollisionObjectWrapper& mesh = mesh_is_body1_ ? *body1 : *body0;
  const btCollisionObjectWrapper& other = mesh_is_body1_ ? *body0 : *body1;
  const auto& mesh_shape = static_cast<const ClusteredOctreeShape&>(*mesh.m_shape);
  const double breaking = double(std::min(
      breakingThreshold(*mesh.getCollisionObject()->getCollisionShape(), &mesh_shape),
      breakingThreshold(*other.getCollisionObject()->getCollisionShape(), asOurShape(*other.m_shape))));
  // contactTest and similar functions use derived results.
  const std::type_info& result_type = typeid(*result);
  const bool is_step = result_type == typeid(btManifoldResult);
  const double margins = double(mesh_shape.getMargin()) + marginOfOther(*other.m_shape),
               reach = (is_step ? kCreated : 1.0) * breaking + margins +
                       double(result->m_closestPointDistanceThreshold);
  PosedShapes shapes{mesh_shape, *other.m_shape,
                     fromBullet(mesh.getWorldTransform()).inverse() * fromBullet(other.getWorldTransform()),
                     breaking, reach};
  noticeChanges(shapes);
  static_assert(std::is_final_v<AllContacts>);
  if (result_type == typeid(AllContacts)) {
    shapes.has_all_triangles = true;
    findTriangleContacts(shapes, contacts_);
    static_cast<AllContacts*>(result)->take(*mesh.getCollisionObject(), contacts_);
    return;
  }
  const bool may_pull = is_step && info.m_timeStep > 0 && mayPull(*other.m_shape);
  if (!is_step || !other_in_mesh_ || reach != reach_ ||
      !areStill(mesh, other, *other_in_mesh_, shapes.other_in_mesh, kStill * breaking)) {
    other_in_mesh_.reset();  // in case of an exception
    if (may_pull) shapes.other_when_apart = way_back_.reference();
    findBodyContacts(shapes, contacts_);
    if (may_pull) pushBack(shapes, mesh, other, info.m_timeStep);
    patches_.reduce(contacts_, breaking);
    if (is_step) noticeRoom();
    other_in_mesh_ = shapes.other_in_mesh;
    reach_ = reach;
  }
  if (may_pull) {
    last_step_ = {fromBullet(mesh.getWorldTransform()), fromBullet(other.getWorldTransform()),
                  info.m_timeStep};
  }
  showPatches(shapes, mesh, other, info.m_timeStep, *result);
}

void MeshAlgorithm::noticeChanges(const PosedShapes& shapes) {
  const ClusteredOctreeShape* const other_mesh = asOurShape(shapes.other);
  const bool mesh_has_changed = keepTree(&shapes.mesh, tree_),
             other_has_changed = keepTree(other_mesh, tree_of_other_);
  if (mesh_has_changed || other_has_changed) trianglesHaveMoved();
  const std::pair are_solid(solidityOf(&shapes.mesh), solidityOf(other_mesh));
  if (mesh_has_changed || other_has_changed || are_solid != are_solid_) {
    manifolds_.clear();
    patches_ = {};
    way_back_.forget();
    other_in_mesh_.reset();
  }
  are_solid_ = are_solid;
  if (!readOther(shapes)) other_in_mesh_.reset();
}

bool MeshAlgorithm::mayPull(const btCollisionShape& other) const {
  if (other.isInfinite()) return false;  // a half-space is solid
  return !are_solid_.first.is_solid || (other.isConcave() && !are_solid_.second.is_solid);
}

void MeshAlgorithm::pushBack(PosedShapes& shapes, const btCollisionObjectWrapper& mesh,
                             const btCollisionObjectWrapper& other, btScalar time_step) {
  const auto overlap = [this] {
    return std::ranges::any_of(contacts_, [](const Contact& contact) { return contact.distance < 0.0; });
  };
  const TriangleMesh& triangles = shapes.treeOfMesh().mesh();
  const std::optional<WayBack::ConvexBody> convex = convexOther();
  const bool may_be_past = convex && way_back_.isThrough() && !contacts_.empty();
  if (!overlap() && !may_be_past) return way_back_.noticeApart(shapes.other_in_mesh);
  const auto sizeOf = [](const Aabb& bounds) { return bounds.halfExtents().norm(); };
  if (convex && sizeOf(shapeBounds(shapes.other)) > sizeOf(triangles.bounds()))
    return way_back_.forget();  // too large for its middle to show its side
  const btScalar length = last_step_ ? last_step_->length : time_step;
  Pose start = startOf(mesh, length, last_step_ ? &last_step_->mesh_in_world : nullptr).inverse() *
               startOf(other, length, last_step_ ? &last_step_->other_in_world : nullptr);
  const std::optional<Pose> last_apart = convex ? std::nullopt : way_back_.lastApart();
  if (way_back_.isNew() || last_apart) {
    findTriangleContacts({shapes.mesh, shapes.other, start, shapes.breaking, 0.0}, contacts_);
    std::optional<Pose> reference;
    if (!overlap()) {
      reference = start;
    } else if (last_apart) {
      // The solver may have moved a deep body farther than its velocity says. If a body has moved farther
      // than it is large, the user has placed it.
      const double size = std::min(sizeOf(shapeBounds(shapes.other)), sizeOf(triangles.bounds()));
      if (areStill(mesh, other, *last_apart, start, size)) reference = last_apart;
    }
    shapes.other_when_apart = reference;
    findBodyContacts(shapes, contacts_);
    // From the next step on, the middle of a convex body shows its side.
    if (!reference) return convex ? way_back_.noticeApart(shapes.other_in_mesh) : way_back_.noticeOverlap();
    start = *reference;
  }
  way_back_.noticeTouch(start);
  if (!convex) return;  // its features know their sides
  const auto open_triangle = [&](const Contact& contact) -> std::optional<Triangle> {
    if (shapes.mesh.solid().boundsSolid(contact.triangle_a)) return std::nullopt;
    return triangles.triangle(contact.triangle_a);
  };
  const auto crossing = [&](const Vec3& from, const Vec3& to) {
    auto hit = closestHit(shapes.treeOfMesh(), {from, to - from, 1.0});
    if (hit && shapes.mesh.solid().boundsSolid(hit->triangle)) hit.reset();
    return hit;
  };
  way_back_.pushBack(contacts_, shapes.other_in_mesh, *convex, open_triangle, crossing);
}

void MeshAlgorithm::noticeRoom() {
  if (patches_.last().empty()) room_.reset();
  room_ = std::max(room_, roomBetween(patches_.last()));  // none is less than any room
}

void MeshAlgorithm::showPatches(const PosedShapes& shapes, const btCollisionObjectWrapper& mesh,
                                const btCollisionObjectWrapper& other, btScalar time_step,
                                btManifoldResult& result) {
  const std::span<const ContactPatch> patches = patches_.last();
  if (patches.empty() && manifolds_.empty()) return;
  const double whole = double(shapes.mesh.getMargin()), whole_of_other = marginOfOther(shapes.other);
  const double fraction = room_ ? std::min(1.0, kTaken * *room_ / (whole + whole_of_other)) : 1.0;
  const double mesh_margin = fraction * whole, other_margin = fraction * whole_of_other;
  const Pose motion = shapes.other_in_mesh * other_in_mesh_->inverse();
  const Vec3 shift = shapes.other_in_mesh.translation - other_in_mesh_->translation;
  const Pose mesh_in_world = fromBullet(mesh.getWorldTransform());
  const btCollisionObject* const body0 = (mesh_is_body1_ ? other : mesh).getCollisionObject();
  const btScalar rounding = roundingBetween(mesh, other, shapes.mesh.tree().mesh().bounds());
  manifolds_.match(patches,
                   {mesh_in_world, fromBullet(mesh.getCollisionObject()->getWorldTransform()), mesh_margin,
                    mesh_is_body1_},
                   std::max(btScalar(shapes.breaking), rounding));
  for (std::size_t p = 0; p < patches.size(); ++p) {
    btPersistentManifold* const manifold = manifolds_.of(p);
    if (!manifold) break;  // the pool is exhausted: drop the contacts, as Bullet does
    result.setPersistentManifold(manifold);
    for (const Contact& found : patches[p].points()) {
      const Contact contact = afterMotion(found, motion, shift);
      const Vec3 to_mesh = mesh_in_world.rotation * contact.normal;
      const Vec3 on_mesh = mesh_in_world * contact.point_on_a - mesh_margin * to_mesh;
      const Vec3 on_other = mesh_in_world * contact.point_on_b + other_margin * to_mesh;
      const ContactSide mesh_side(mesh, triangleOf(shapes.mesh, contact.triangle_a));
      const ContactSide other_side(other, triangleOfOther(shapes.other, contact));
      const ShownSides shown(result, body0, mesh_is_body1_ ? other_side : mesh_side,
                             mesh_is_body1_ ? mesh_side : other_side);
      // Bullet's normal is on body 1 and points to body 0.
      result.addContactPoint(toBullet(mesh_is_body1_ ? Vec3(-to_mesh) : to_mesh),
                             toBullet(mesh_is_body1_ ? on_mesh : on_other),
                             btScalar(contact.distance - mesh_margin - other_margin));
    }
    result.refreshContactPoints();
    correctForStep(*manifold, time_step);
  }
}

}  // namespace octoblisk::detail
