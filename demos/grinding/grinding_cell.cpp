#include "grinding/grinding_cell.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "contact/contact_patches.h"
#include "grinding/obstacles.h"
#include "octoblisk/distance.h"
#include "octoblisk_bullet/all_contacts.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/register.h"

namespace octoblisk::demos {

struct GrindingCell::World {
  struct Body {
    Body(std::shared_ptr<const ClusteredOctree> tree, double reach) : shape(std::move(tree)) {
      shape.setMargin(0);
      shape.setContactBreakingThreshold(btScalar(reach));
      object.setCollisionShape(&shape);
    }
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;

    btCollisionObjectWrapper wrapper() const {
      return {nullptr, &shape, &object, object.getWorldTransform(), -1, -1};
    }

    ClusteredOctreeShape shape;
    btCollisionObject object;
  };

  /// A target and a part, with the algorithm that Bullet dispatches for them. The smaller reach of the two
  /// counts.
  class Pair {
   public:
    Pair(btCollisionDispatcher& dispatcher, const Body& target, const Body& part)
        : dispatcher_(dispatcher), target_(target.wrapper()), part_(part.wrapper()) {
      algorithm_ = dispatcher.findAlgorithm(&target_, &part_, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    }
    ~Pair() {
      algorithm_->~btCollisionAlgorithm();
      dispatcher_.freeCollisionAlgorithm(algorithm_);
    }
    Pair(const Pair&) = delete;
    Pair& operator=(const Pair&) = delete;

    /// With the target as A; valid until the next call.
    std::span<const Contact> contacts() {
      AllContacts all(&target_, &part_);
      algorithm_->processCollision(&target_, &part_, info_, &all);
      return all.contacts();
    }

   private:
    btCollisionDispatcher& dispatcher_;
    btCollisionObjectWrapper target_, part_;
    btDispatcherInfo info_;
    btCollisionAlgorithm* algorithm_;
  };

  World() { registerAlgorithm(&dispatcher); }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  std::vector<std::unique_ptr<Body>> parts;
  std::map<std::pair<const ClusteredOctree*, double>, Body> targets;  // by tree and reach
  // Of each part: with the blisk, if it may touch any of it, and with everything that it must not touch.
  std::vector<std::unique_ptr<Pair>> allowed, forbidden;
};

GrindingCell::GrindingCell(std::shared_ptr<const ClusteredOctree> blisk, std::vector<ToolPart> parts,
                           std::vector<double> reaches, const Obstacles* obstacles)
    : blisk_(std::move(blisk)),
      parts_(std::move(parts)),
      reaches_(std::move(reaches)),
      obstacles_(obstacles),
      world_(std::make_unique<World>()) {
  const double greatest = reaches_.empty() ? 0.0 : *std::ranges::max_element(reaches_);
  const auto pairWith = [&](const std::shared_ptr<const ClusteredOctree>& tree, double reach) {
    const auto target = world_->targets.try_emplace({tree.get(), reach}, tree, reach).first;
    return std::make_unique<World::Pair>(world_->dispatcher, target->second, *world_->parts.back());
  };
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    world_->parts.push_back(std::make_unique<World::Body>(parts_[part].tree, reaches_[part]));
    const bool may_touch = obstacles && obstacles->mayTouchAny(part);
    world_->allowed.push_back(may_touch ? pairWith(blisk_, 0.0) : nullptr);
    const Obstacle* const obstacle = obstacles ? obstacles->of(part) : nullptr;
    world_->forbidden.push_back(obstacle     ? pairWith(obstacle->sharedTree(), greatest)
                                : !obstacles ? pairWith(blisk_, greatest)
                                             : nullptr);
  }
}

GrindingCell::~GrindingCell() = default;

std::vector<Touch> GrindingCell::touchesAt(const Pose& tool_in_blisk) {
  std::vector<Touch> found;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    world_->parts[part]->object.setWorldTransform(toBullet(tool_in_blisk));
    if (world_->allowed[part]) addAllowed(part, tool_in_blisk, found);
    if (!world_->forbidden[part]) continue;
    for (Contact contact : world_->forbidden[part]->contacts()) {
      if (obstacles_) contact.triangle_a = obstacles_->of(part)->triangleOfAll(contact.triangle_a);
      found.push_back({.part = part, .contact = contact});
    }
  }
  return found;
}

/// Contacts with the blades that the part may touch: those that touch, or otherwise the nearest pair.
void GrindingCell::addAllowed(std::size_t part, const Pose& tool_in_blisk, std::vector<Touch>& found) {
  const auto mayTouch = [&](std::uint32_t triangle) { return obstacles_->mayTouch(part, triangle); };
  const std::size_t before = found.size();
  for (const Contact& contact : world_->allowed[part]->contacts()) {
    if (mayTouch(contact.triangle_a)) found.push_back({.part = part, .contact = contact});
  }
  if (found.size() > before) return;
  const Clearance nearest =
      distance(*blisk_, *parts_[part].tree, tool_in_blisk, {.upper_bound = reaches_[part]});
  if (!nearest.found() || nearest.distance == 0.0 || !mayTouch(nearest.triangle_a)) return;
  found.push_back(touchAt(part, 0, nearest));
}

std::vector<Touch> reduceContacts(std::span<const Touch> touches, std::span<const int> body_of_triangle) {
  std::map<std::pair<std::size_t, int>, std::vector<Contact>> by_part_and_body;
  for (const Touch& touch : touches) {
    by_part_and_body[{touch.part, body_of_triangle[touch.contact.triangle_a]}].push_back(touch.contact);
  }
  std::vector<Touch> kept;
  for (const auto& [part_and_body, group] : by_part_and_body) {
    detail::ContactPatches patches;
    for (const detail::ContactPatch& patch : patches.reduce(group, 0.0)) {
      for (const Contact& contact : patch.points()) {
        kept.push_back({.part = part_and_body.first, .blade = part_and_body.second, .contact = contact});
      }
    }
  }
  return kept;
}

}  // namespace octoblisk::demos
