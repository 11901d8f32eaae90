#include "octoblisk_bullet/adopt_meshes.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btMultimaterialTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <BulletDynamics/Dynamics/btDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <map>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/register.h"

namespace octoblisk {
namespace {

/// The triangles of one of Bullet's meshes.
struct MeshSource {
  const btStridingMeshInterface* triangles;
  btVector3 scaling;

  using Key = std::tuple<const btStridingMeshInterface*, btScalar, btScalar, btScalar>;
  Key key() const { return {triangles, scaling.x(), scaling.y(), scaling.z()}; }
};

/// None if the shape is not a mesh that ClusteredOctreeShape replaces.
std::optional<MeshSource> sourceOf(const btCollisionShape& shape) {
  if (const auto* scaled = dynamic_cast<const btScaledBvhTriangleMeshShape*>(&shape)) {
    const btStridingMeshInterface* triangles = scaled->getChildShape()->getMeshInterface();
    return MeshSource{triangles, triangles->getScaling() * scaled->getLocalScaling()};
  }
  if (const auto* mesh = dynamic_cast<const btBvhTriangleMeshShape*>(&shape))
    return MeshSource{mesh->getMeshInterface(), mesh->getMeshInterface()->getScaling()};
  if (const auto* mesh = dynamic_cast<const btGImpactMeshShape*>(&shape)) {
    // Without setLocalScaling, only the parts know the scaling.
    const bool has_parts = mesh->getMeshPartCount() > 0;
    return MeshSource{mesh->getMeshInterface(),
                      has_parts ? mesh->getMeshPart(0)->getLocalScaling() : mesh->getLocalScaling()};
  }
  return std::nullopt;
}

/// Why a mesh of Bullet stays; null if it can be replaced, or if the shape is no mesh.
const char* whyLeft(const btCollisionShape& shape) {
  if (dynamic_cast<const btMultimaterialTriangleMeshShape*>(&shape))
    return "btMultimaterialTriangleMeshShape: its materials are found by its type";
  if (dynamic_cast<const btGImpactCompoundShape*>(&shape))
    return "btGImpactCompoundShape: it is not one mesh";
  if (dynamic_cast<const btGImpactMeshShapePart*>(&shape))
    return "btGImpactMeshShapePart: it is a part of another shape";
  return nullptr;
}

/// Whether the inertia of a body is that of its shape up to rounding.
bool hasInertiaOf(const btCollisionShape& shape, const btRigidBody& body) {
  btVector3 computed;
  shape.calculateLocalInertia(body.getMass(), computed);
  const btVector3 difference = (computed - body.getLocalInertia()).absolute();
  return difference[difference.maxAxis()] <= btScalar(1e-4) * computed[computed.maxAxis()];
}

}  // namespace

class AdoptedMeshes::Adoption {
 public:
  explicit Adoption(btCollisionWorld& world) : world_(world) {}
  ~Adoption() = default;
  Adoption(const Adoption&) = delete;
  Adoption& operator=(const Adoption&) = delete;

  std::vector<Replaced> replaced;
  std::vector<Left> left;

  /// Makes the new shapes, and changes nothing else.
  void makeShapes(const BuildOptions& options) {
    for (int i = 0; i < objects().size(); ++i) makeShapes(*objects()[i]->getCollisionShape(), options);
    for (const Replaced& mesh : replaced) replacement_[mesh.before] = mesh.now;
  }

  /// Finds the bodies that are to be dynamic.
  void findMasses(const std::function<btScalar(const btRigidBody&)>& mass_of) {
    auto* const world = dynamic_cast<btDynamicsWorld*>(&world_);
    for (int i = 0; world && mass_of && i < objects().size(); ++i) {
      btRigidBody* const body = btRigidBody::upcast(objects()[i]);
      if (!body || !body->isStaticObject()) continue;
      const Parts parts = partsOf(*body->getCollisionShape());
      if (!parts.any_replaced) continue;
      const btScalar mass = mass_of(*body);
      if (!(mass > 0)) continue;
      if (parts.any_unmovable) {
        left.push_back({body->getCollisionShape(), "the body stays static: a part of its shape cannot move"});
      } else {
        masses_.emplace_back(body, mass);
      }
    }
  }

  void apply() {
    registerAlgorithm(static_cast<btCollisionDispatcher*>(world_.getDispatcher()));
    for (int i = 0; i < objects().size(); ++i) {
      if (btRigidBody* const body = btRigidBody::upcast(objects()[i])) noteInertia(*body);
    }
    exchangeAll();
    for (const auto& [body, inertia] : inertias_) {
      btVector3 exact;
      body->getCollisionShape()->calculateLocalInertia(body->getMass(), exact);
      setMass(*body, body->getMass(), exact);
    }
    for (const auto& [body, mass] : masses_) makeDynamic(*body, mass);
  }

  void putBack() {
    if (replacement_.empty()) return;
    replacement_.clear();
    for (const Replaced& mesh : replaced) replacement_[mesh.now] = mesh.before;
    exchangeAll();
    for (const auto& [body, inertia] : inertias_) {
      if (isInWorld(*body)) setMass(*body, body->getMass(), inertia);
    }
    for (const Former& former : formers_) {
      if (isInWorld(*former.body)) makeStatic(former);
    }
    replacement_.clear();
  }

 private:
  struct Parts {
    bool any_replaced = false, any_unmovable = false;
  };
  /// A body that was static.
  struct Former {
    btRigidBody* body;
    int group, mask, activation;
  };

  btCollisionObjectArray& objects() { return world_.getCollisionObjectArray(); }
  btDynamicsWorld& dynamicsWorld() { return static_cast<btDynamicsWorld&>(world_); }
  bool isInWorld(btCollisionObject& object) { return objects().findLinearSearch(&object) < objects().size(); }

  void makeShapes(btCollisionShape& shape, const BuildOptions& options) {
    if (const auto* compound = dynamic_cast<const btCompoundShape*>(&shape)) {
      for (int i = 0; i < compound->getNumChildShapes(); ++i)
        makeShapes(const_cast<btCollisionShape&>(*compound->getChildShape(i)), options);
      return;
    }
    if (!seen_.insert(&shape).second) return;
    if (const char* const why = whyLeft(shape)) {
      left.push_back({&shape, why});
    } else if (const std::optional<MeshSource> source = sourceOf(shape)) {
      try {
        shapes_.push_back(made(*source, shape, options));
        replaced.push_back({&shape, shapes_.back().get()});
      } catch (const std::invalid_argument& error) {
        left.push_back({&shape, error.what()});
      }
    }
  }

  std::unique_ptr<ClusteredOctreeShape> made(const MeshSource& source, const btCollisionShape& before,
                                             const BuildOptions& options) {
    auto& over_source = made_[source.key()];
    if (!over_source)
      over_source = std::make_unique<ClusteredOctreeShape>(source.triangles, source.scaling, options);
    auto shape = std::make_unique<ClusteredOctreeShape>(*over_source);
    if (before.getMargin() > 0) shape->setMargin(before.getMargin());
    shape->setUserPointer(before.getUserPointer());
    shape->setUserIndex(before.getUserIndex());
    shape->setUserIndex2(before.getUserIndex2());
    return shape;
  }

  Parts partsOf(const btCollisionShape& shape) const {
    if (const auto* compound = dynamic_cast<const btCompoundShape*>(&shape)) {
      Parts all;
      for (int i = 0; i < compound->getNumChildShapes(); ++i) {
        const Parts parts = partsOf(*compound->getChildShape(i));
        all.any_replaced |= parts.any_replaced;
        all.any_unmovable |= parts.any_unmovable;
      }
      return all;
    }
    const bool is_replaced = replacementOf(&shape) != nullptr;
    return {is_replaced, !is_replaced && shape.isNonMoving()};
  }

  /// The shape that replaces this one; null if it stays.
  btCollisionShape* replacementOf(const btCollisionShape* shape) const {
    const auto found = replacement_.find(shape);
    return found == replacement_.end() ? nullptr : found->second;
  }

  /// Replaces the shapes of all objects. A compound is changed once, although several objects may use it.
  void exchangeAll() {
    std::map<btCompoundShape*, bool> has_changed;
    for (int i = 0; i < objects().size(); ++i) {
      btCollisionObject& object = *objects()[i];
      btCollisionShape* const before = object.getCollisionShape();
      if (btCollisionShape* const now = replacementOf(before)) {
        object.setCollisionShape(now);
      } else if (auto* const compound = dynamic_cast<btCompoundShape*>(before);
                 !compound || !exchangeChildren(*compound, has_changed)) {
        continue;
      }
      forgetPairs(object);
      if (!object.isStaticOrKinematicObject()) object.activate();
    }
  }

  bool exchangeChildren(btCompoundShape& compound, std::map<btCompoundShape*, bool>& has_changed) {
    const auto [known, is_new] = has_changed.try_emplace(&compound, false);
    if (!is_new) return known->second;
    bool changes = false;
    for (int i = 0; i < compound.getNumChildShapes(); ++i) {
      btCompoundShapeChild& child = compound.getChildList()[i];
      if (btCollisionShape* const now = replacementOf(child.m_childShape)) {
        child.m_childShape = now;
        child.m_childShapeType = now->getShapeType();
        child.m_childMargin = now->getMargin();
      } else if (auto* const inner = dynamic_cast<btCompoundShape*>(child.m_childShape);
                 !inner || !exchangeChildren(*inner, has_changed)) {
        continue;
      }
      compound.updateChildTransform(i, child.m_transform, false);
      changes = true;
    }
    if (changes) compound.recalculateLocalAabb();
    return has_changed[&compound] = changes;
  }

  /// Discards the algorithms that were made for the former shapes.
  void forgetPairs(btCollisionObject& object) {
    btBroadphaseProxy* const proxy = object.getBroadphaseHandle();
    if (!proxy) return;
    world_.getBroadphase()->getOverlappingPairCache()->cleanProxyFromPairs(proxy, world_.getDispatcher());
    world_.updateSingleAabb(&object);
  }

  /// Notes the inertia of a dynamic body if the mesh that will be replaced computed it.
  void noteInertia(btRigidBody& body) {
    const btCollisionShape* const mesh = body.getCollisionShape();
    if (body.isStaticOrKinematicObject() || !replacementOf(mesh)) return;
    if (hasInertiaOf(*mesh, body)) inertias_.emplace_back(&body, body.getLocalInertia());
  }

  static void setMass(btRigidBody& body, btScalar mass, const btVector3& inertia) {
    body.setMassProps(mass, inertia);
    body.updateInertiaTensor();
  }

  void makeDynamic(btRigidBody& body, btScalar mass) {
    const btBroadphaseProxy& proxy = *body.getBroadphaseHandle();
    Former former{&body, proxy.m_collisionFilterGroup, proxy.m_collisionFilterMask,
                  body.getActivationState()};
    dynamicsWorld().removeRigidBody(&body);
    btVector3 inertia;
    body.getCollisionShape()->calculateLocalInertia(mass, inertia);
    setMass(body, mass, inertia);
    body.forceActivationState(ACTIVE_TAG);
    constexpr int kAll = btBroadphaseProxy::AllFilter, kStatic = btBroadphaseProxy::StaticFilter;
    if (former.group == kStatic && former.mask == (kAll ^ kStatic)) {
      dynamicsWorld().addRigidBody(&body);
    } else {
      dynamicsWorld().addRigidBody(&body, former.group, former.mask);
    }
    formers_.push_back(former);
  }

  void makeStatic(const Former& former) {
    dynamicsWorld().removeRigidBody(former.body);
    setMass(*former.body, 0, btVector3(0, 0, 0));
    former.body->setLinearVelocity(btVector3(0, 0, 0));
    former.body->setAngularVelocity(btVector3(0, 0, 0));
    former.body->forceActivationState(former.activation);
    dynamicsWorld().addRigidBody(former.body, former.group, former.mask);
  }

  btCollisionWorld& world_;
  std::vector<std::unique_ptr<ClusteredOctreeShape>> shapes_;
  std::map<MeshSource::Key, std::unique_ptr<const ClusteredOctreeShape>> made_;  // with default margins
  std::unordered_set<const btCollisionShape*> seen_;
  std::unordered_map<const btCollisionShape*, btCollisionShape*> replacement_;
  std::vector<std::pair<btRigidBody*, btVector3>> inertias_;
  std::vector<std::pair<btRigidBody*, btScalar>> masses_;
  std::vector<Former> formers_;
};

AdoptedMeshes::AdoptedMeshes(std::unique_ptr<Adoption> adoption) : adoption_(std::move(adoption)) {}
AdoptedMeshes::AdoptedMeshes(AdoptedMeshes&&) noexcept = default;
AdoptedMeshes& AdoptedMeshes::operator=(AdoptedMeshes&&) noexcept = default;
AdoptedMeshes::~AdoptedMeshes() = default;

const std::vector<AdoptedMeshes::Replaced>& AdoptedMeshes::replaced() const { return adoption_->replaced; }
const std::vector<AdoptedMeshes::Left>& AdoptedMeshes::left() const { return adoption_->left; }
void AdoptedMeshes::putBack() { adoption_->putBack(); }

AdoptedMeshes adoptMeshes(btCollisionWorld& world, const std::function<btScalar(const btRigidBody&)>& mass_of,
                          const BuildOptions& options) {
  auto adoption = std::make_unique<AdoptedMeshes::Adoption>(world);
  adoption->makeShapes(options);
  adoption->findMasses(mass_of);
  adoption->apply();
  return AdoptedMeshes(std::move(adoption));
}

}  // namespace octoblisk
