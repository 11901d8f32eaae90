// Our own by way of Bullet: two shapes of the plugin in a Bullet world.
#include "bullet_world.h"
#include "contender.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/register.h"

namespace octoblisk::bench {
namespace {

std::shared_ptr<const ClusteredOctree> treeOf(const std::shared_ptr<const TriangleMesh>& mesh) {
  return std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh));
}

/// Counts the contact points that reach Bullet.
class OctoBliskBullet final : public ContactsQuery {
 public:
  explicit OctoBliskBullet(const Scene& scene) : blisk_(treeOf(scene.blisk)), belt_(treeOf(scene.belt)) {
    for (ClusteredOctreeShape* shape : {&blisk_, &belt_}) {
      shape->setMargin(0);
      shape->setContactBreakingThreshold(0);
    }
    registerAlgorithm(&world_.dispatcher());
  }

  std::size_t contacts(const Pose& belt_in_blisk) override { return world_.contacts(belt_in_blisk); }
  bool countsPairs() const override { return false; }

 private:
  ClusteredOctreeShape blisk_, belt_;
  BulletWorld world_{&blisk_, &belt_};
};

const bool kRegistered = registerContender<OctoBliskBullet>("octoblisk-bullet");

}  // namespace
}  // namespace octoblisk::bench
