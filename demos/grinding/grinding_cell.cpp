#include "grinding/grinding_cell.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "grinding/obstacles.h"
#include "octoblisk/distance.h"
#include "octoblisk_bullet/all_contacts.h"
#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/kinematic_body.h"
#include "octoblisk_bullet/register.h"

namespace octoblisk::demos {

/// Bullet's world with the blisk, its obstacles and the parts of the tool as bodies. The broadphase decides
/// which bodies meet; the algorithm that the dispatcher runs on a pair finds its contacts.
class GrindingCell::World {
 public:
  World(const std::shared_ptr<const ClusteredOctree>& blisk, const std::vector<ToolPart>& parts,
        const std::vector<double>& reaches, const Obstacles* obstacles)
      : world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    registerAlgorithm(&dispatcher_);
    broadphase_.getOverlappingPairCache()->setOverlapFilterCallback(&filter_);
    // The smaller reach of two bodies counts.
    const double reach = reaches.empty() ? 0.0 : *std::ranges::max_element(reaches);
    targets_.push_back(std::make_unique<Body>(blisk, reach));
    targets_.push_back(std::make_unique<Body>(blisk, 0.0));
    std::map<const Obstacle*, std::size_t> target_of;
    for (std::size_t part = 0; part < parts.size(); ++part) {
      parts_.push_back(std::make_unique<Body>(parts[part].tree, reaches[part]));
      parts_.back()->body.setUserIndex(static_cast<int>(part));
      touched_.push_back(kNone);
      forbidden_.push_back(kWholeBlisk);
      if (!obstacles) continue;
      if (obstacles->mayTouchAny(part)) touched_[part] = kTouchedBlisk;
      const Obstacle* const obstacle = obstacles->of(part);
      if (!obstacle) forbidden_[part] = kNone;
      if (!obstacle || obstacle->sharedTree() == blisk) continue;
      const auto [known, is_new] = target_of.try_emplace(obstacle, targets_.size());
      if (is_new) targets_.push_back(std::make_unique<Body>(obstacle->sharedTree(), reach));
      forbidden_[part] = known->second;
    }
    for (std::size_t target = 0; target < targets_.size(); ++target) {
      targets_[target]->body.setUserIndex(static_cast<int>(target));
      world_.addRigidBody(&targets_[target]->body);
    }
    for (const auto& part : parts_) addKinematicBody(world_, part->body);
    found_.resize(parts_.size() * targets_.size());
  }

  ~World() {
    for (const auto& part : parts_) world_.removeRigidBody(&part->body);
    for (const auto& target : targets_) world_.removeRigidBody(&target->body);
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const ClusteredOctree& blisk() const { return targets_.front()->shape.tree(); }

  /// Moves the tool to the pose and has Bullet detect all collisions.
  void detect(const Pose& tool_in_blisk) {
    pairs_dispatched_ = 0;
    for (std::vector<Contact>& contacts : found_) contacts.clear();
    for (const auto& part : parts_) {
      part->body.setWorldTransform(toBullet(tool_in_blisk));
      // Bullet does not move the boxes of bodies that are larger than a million units. It would also ignore
      // the body, but addKinematicBody has turned deactivation off.
      btVector3 min, max;
      part->body.getAabb(min, max);
      broadphase_.setAabb(part->body.getBroadphaseProxy(), min, max, &dispatcher_);
    }
    world_.performDiscreteCollisionDetection();
  }

  std::size_t pairsDispatched() const { return pairs_dispatched_; }

  /// The last detected touches of a part with the blades that it may touch.
  std::span<const Contact> touches(std::size_t part) const { return found(part, touched_[part]); }
  /// The last detected contacts with anything that it must not touch, within its reach. A's triangles are the
  /// obstacle's.
  std::span<const Contact> forbidden(std::size_t part) const { return found(part, forbidden_[part]); }

 private:
  static constexpr std::size_t kWholeBlisk = 0, kTouchedBlisk = 1, kNone = ~std::size_t{0};

  /// A body and its shape.
  struct Body {
    Body(std::shared_ptr<const ClusteredOctree> tree, double reach)
        : shape(std::move(tree)), body(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &shape)) {
      shape.setMargin(0);
      shape.setContactBreakingThreshold(btScalar(reach));
    }

    ClusteredOctreeShape shape;
    btRigidBody body;
  };

  /// Pairs each part only with its own targets.
  class Filter final : public btOverlapFilterCallback {
   public:
    explicit Filter(const World& world) : world_(world) {}
    bool needBroadphaseCollision(btBroadphaseProxy* one, btBroadphaseProxy* other) const override {
      const auto *first = static_cast<const btCollisionObject*>(one->m_clientObject),
                 *second = static_cast<const btCollisionObject*>(other->m_clientObject);
      if (first->isStaticObject() == second->isStaticObject()) return false;
      if (second->isStaticObject()) std::swap(first, second);
      return world_.meets(static_cast<std::size_t>(second->getUserIndex()),
                          static_cast<std::size_t>(first->getUserIndex()));
    }

   private:
    const World& world_;
  };

  /// Bullet's dispatcher; its pairs report all their contacts to the world.
  class Dispatcher final : public btCollisionDispatcher {
   public:
    Dispatcher(btCollisionConfiguration* configuration, World& world)
        : btCollisionDispatcher(configuration), world_(world) {
      setNearCallback([](btBroadphasePair& pair, btCollisionDispatcher& dispatcher, const btDispatcherInfo&) {
        static_cast<Dispatcher&>(dispatcher).collide(pair);
      });
    }

   private:
    void collide(btBroadphasePair& pair) {
      const auto *one = static_cast<const btCollisionObject*>(pair.m_pProxy0->m_clientObject),
                 *other = static_cast<const btCollisionObject*>(pair.m_pProxy1->m_clientObject);
      world_.collide(*one, *other, pair.m_algorithm);
    }

    World& world_;
  };

  bool meets(std::size_t part, std::size_t target) const {
    return touched_[part] == target || forbidden_[part] == target;
  }

  std::span<const Contact> found(std::size_t part, std::size_t target) const {
    if (target == kNone) return {};
    return found_[part * targets_.size() + target];
  }

  /// Runs the pair's algorithm; creates it first if it is null.
  void collide(const btCollisionObject& one, const btCollisionObject& other,
               btCollisionAlgorithm*& algorithm) {
    const bool in_order = one.isStaticObject();  // the target comes first: it is A of the contacts
    const btCollisionObject &target = in_order ? one : other, &part = in_order ? other : one;
    const btCollisionObjectWrapper a(nullptr, target.getCollisionShape(), &target, target.getWorldTransform(),
                                     -1, -1),
        b(nullptr, part.getCollisionShape(), &part, part.getWorldTransform(), -1, -1);
    if (!algorithm) algorithm = dispatcher_.findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    ++pairs_dispatched_;
    AllContacts all(&a, &b);
    algorithm->processCollision(&a, &b, world_.getDispatchInfo(), &all);
    const auto place = static_cast<std::size_t>(part.getUserIndex()) * targets_.size() +
                       static_cast<std::size_t>(target.getUserIndex());
    found_[place].assign(all.contacts().begin(), all.contacts().end());
  }

  btDefaultCollisionConfiguration configuration_;
  Dispatcher dispatcher_{&configuration_, *this};
  ClusteredOctreeBroadphase broadphase_;
  Filter filter_{*this};
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::vector<std::unique_ptr<Body>> targets_;  // the blisk, the blisk that may be touched, obstacles
  std::vector<std::unique_ptr<Body>> parts_;
  std::vector<std::size_t> touched_, forbidden_;  // of each part: its targets
  std::vector<std::vector<Contact>> found_;       // of each part and target
  std::size_t pairs_dispatched_ = 0;
};

GrindingCell::GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                           double reach)
    : GrindingCell(std::move(blisk), parts, std::vector<double>(parts.size(), reach)) {}

GrindingCell::GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                           std::vector<double> reaches)
    : parts_(std::move(parts)),
      reaches_(std::move(reaches)),
      world_(std::make_unique<World>(blisk, parts_, reaches_, nullptr)) {}

GrindingCell::GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                           std::vector<double> reaches, const Obstacles& obstacles)
    : parts_(std::move(parts)),
      reaches_(std::move(reaches)),
      obstacles_(&obstacles),
      world_(std::make_unique<World>(blisk, parts_, reaches_, &obstacles)) {}

GrindingCell::~GrindingCell() = default;

const ClusteredOctree& GrindingCell::blisk() const { return world_->blisk(); }

std::size_t GrindingCell::pairsDispatched() const { return world_->pairsDispatched(); }

std::vector<PartContact> GrindingCell::contactsAt(const Pose& tool_in_blisk) {
  std::vector<PartContact> found;
  world_->detect(tool_in_blisk);
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (obstacles_ && obstacles_->mayTouchAny(part)) addTouches(part, tool_in_blisk, found);
    for (Contact contact : world_->forbidden(part)) {
      if (obstacles_) contact.triangle_a = obstacles_->of(part)->triangleOfAll(contact.triangle_a);
      found.push_back({part, contact});
    }
  }
  return found;
}

/// Contacts with the blades that the part may touch: its touches, or otherwise the nearest pair.
void GrindingCell::addTouches(std::size_t part, const Pose& tool_in_blisk, std::vector<PartContact>& found) {
  const auto mayTouch = [&](std::uint32_t triangle) { return obstacles_->mayTouch(part, triangle); };
  const std::size_t before = found.size();
  for (const Contact& contact : world_->touches(part)) {
    if (mayTouch(contact.triangle_a)) found.push_back({part, contact});
  }
  if (found.size() > before) return;
  const Clearance nearest =
      distance(blisk(), *parts_[part].tree, tool_in_blisk, {.upper_bound = reaches_[part]});
  if (!nearest.found() || nearest.distance == 0.0 || !mayTouch(nearest.triangle_a)) return;
  Contact contact{.triangle_a = nearest.triangle_a, .triangle_b = nearest.triangle_b};
  contact.point_on_a = nearest.point_on_a;
  contact.point_on_b = nearest.point_on_b;
  contact.normal = (nearest.point_on_a - nearest.point_on_b).normalized();
  contact.distance = nearest.distance;
  found.push_back({part, contact});
}

}  // namespace octoblisk::demos
