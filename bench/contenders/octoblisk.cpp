// Our own: the clustered octree.
#include <optional>

#include "contender.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"

namespace octoblisk::bench {
namespace {

class OctoBlisk final : public CollideQuery, public ContactsQuery {
 public:
  explicit OctoBlisk(const Scene& scene)
      : blisk_(ClusteredOctree::build(scene.blisk)), belt_(ClusteredOctree::build(scene.belt)) {}

  bool collides(const Pose& belt_in_blisk) override {
    return collide(blisk_, belt_, belt_in_blisk).has_value();
  }

  /// With points, normals and depths.
  std::size_t contacts(const Pose& belt_in_blisk) override {
    octoblisk::contacts(blisk_, belt_, belt_in_blisk, 0.0, found_);
    return found_.size();
  }

 private:
  ClusteredOctree blisk_, belt_;
  std::vector<Contact> found_;
};

class OctoBliskBuild final : public BuildQuery {
 public:
  explicit OctoBliskBuild(const Scene& scene) : mesh_(scene.blisk) {}

  void build() override {
    clear();
    tree_ = ClusteredOctree::build(mesh_);
  }
  void clear() override { tree_.reset(); }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  std::optional<ClusteredOctree> tree_;
};

const bool kRegistered = registerContender<OctoBlisk, OctoBliskBuild>(kOurs);

}  // namespace
}  // namespace octoblisk::bench
