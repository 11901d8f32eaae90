// Our own by way of Bullet: two shapes of the plugin in a Bullet world.
#include "bullet_world.h"
#include "contender.h"
#include "hulls_on_blisk.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/register.h"

namespace octoblisk::bench {
namespace {

std::shared_ptr<const ClusteredOctree> treeOf(const std::shared_ptr<const TriangleMesh>& mesh) {
  return std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh));
}

class OctoBliskContacts final : public WorldContactsQuery {
 public:
  explicit OctoBliskContacts(const Scene& scene) : blisk_(treeOf(scene.blisk)), belt_(treeOf(scene.belt)) {
    for (ClusteredOctreeShape* shape : {&blisk_, &belt_}) {
      shape->setMargin(0);
      shape->setContactBreakingThreshold(0);
    }
    registerAlgorithm(&world_.dispatcher());
  }

  std::size_t points(const Pose& belt_in_blisk) override { return world_.contacts(belt_in_blisk); }

 private:
  ClusteredOctreeShape blisk_, belt_;
  BulletWorld world_{&blisk_, &belt_};
};

class OctoBliskSteps final : public HullsOnBlisk {
 public:
  explicit OctoBliskSteps(const Scene& scene) : blisk_(treeOf(scene.blisk)) {
    registerAlgorithm(&dispatcher());
    blisk_.setMargin(kMargin);
    start(&blisk_);
  }
  ~OctoBliskSteps() override { stop(); }

 private:
  ClusteredOctreeShape blisk_;
};

const bool kRegistered = registerContender<OctoBliskContacts, OctoBliskSteps>(kOurs);

}  // namespace
}  // namespace octoblisk::bench
