// Our own: the clustered octree.
#include <optional>

#include "contender.h"
#include "octoblisk/build_options.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "octoblisk/distance.h"
#include "octoblisk/raycast.h"

namespace octoblisk::bench {
namespace {

class OctoBlisk : public CollideQuery, public ContactsQuery, public DistanceQuery {
 public:
  explicit OctoBlisk(const Scene& scene, const BuildOptions& options = {})
      : blisk_(ClusteredOctree::build(scene.blisk, options)),
        belt_(ClusteredOctree::build(scene.belt, options)) {}

  bool collides(const Pose& belt_in_blisk) override {
    return collide(blisk_, belt_, belt_in_blisk).has_value();
  }

  std::size_t contacts(const Pose& belt_in_blisk) override {
    touchingPairs(blisk_, belt_, belt_in_blisk, pairs_);
    return pairs_.size();
  }

  double distance(const Pose& belt_in_blisk, bool warm) override {
    DistanceOptions options;
    if (warm) options.hint = nearest_;
    const Clearance clearance = octoblisk::distance(blisk_, belt_, belt_in_blisk, options);
    nearest_ = {clearance.triangle_a, clearance.triangle_b};
    return clearance.distance;
  }

 private:
  ClusteredOctree blisk_, belt_;
  std::vector<TrianglePair> pairs_;
  TrianglePair nearest_;  // of the call before
};

/// With points, normals and depths.
class OctoBliskPoints final : public ContactsQuery {
 public:
  explicit OctoBliskPoints(const Scene& scene)
      : blisk_(ClusteredOctree::build(scene.blisk)), belt_(ClusteredOctree::build(scene.belt)) {}

  std::size_t contacts(const Pose& belt_in_blisk) override {
    octoblisk::contacts(blisk_, belt_, belt_in_blisk, 0.0, found_);
    return found_.size();
  }

 private:
  ClusteredOctree blisk_, belt_;
  std::vector<Contact> found_;
};

class OctoBliskRays : public RayQuery {
 public:
  explicit OctoBliskRays(const Scene& scene, const BuildOptions& options = {})
      : blisk_(ClusteredOctree::build(scene.blisk, options)) {}

  double firstHit(const Segment& way) override {
    Ray ray;
    ray.origin = way.from;
    ray.direction = way.to - way.from;
    ray.t_max = 1.0;
    const std::optional<RayHit> hit = closestHit(blisk_, ray);
    return hit ? hit->t : 1.0;
  }

 private:
  ClusteredOctree blisk_;
};

class OctoBliskBuild : public BuildQuery {
 public:
  explicit OctoBliskBuild(const Scene& scene, const BuildOptions& options = {})
      : mesh_(scene.blisk), options_(options) {}

  void build() override {
    clear();
    tree_ = ClusteredOctree::build(mesh_, options_);
  }
  void clear() override { tree_.reset(); }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  BuildOptions options_;
  std::optional<ClusteredOctree> tree_;
};

/// The tree that takes least memory.
class CompactOctoBlisk final : public OctoBlisk {
 public:
  explicit CompactOctoBlisk(const Scene& scene) : OctoBlisk(scene, {.storage = Storage::compact}) {}
};
class CompactOctoBliskRays final : public OctoBliskRays {
 public:
  explicit CompactOctoBliskRays(const Scene& scene) : OctoBliskRays(scene, {.storage = Storage::compact}) {}
};
class CompactOctoBliskBuild final : public OctoBliskBuild {
 public:
  explicit CompactOctoBliskBuild(const Scene& scene) : OctoBliskBuild(scene, {.storage = Storage::compact}) {}
};

/// Registers a build by other options, as a contender of its own.
bool registerBuild(const std::string& name, const BuildOptions& options) {
  Contender contender{.name = name};
  contender.build = [options](const Scene& scene) {
    return std::make_unique<OctoBliskBuild>(scene, options);
  };
  return registerContender(std::move(contender));
}

const bool kOneThread = registerBuild("octoblisk-1-thread", {.threads = 1});
const bool kFast = registerBuild("octoblisk-fast", {.quality = BuildQuality::fast});
const bool kRegistered = registerContender<OctoBlisk, OctoBliskRays, OctoBliskBuild>(kOurs);
const bool kCompact =
    registerContender<CompactOctoBlisk, CompactOctoBliskRays, CompactOctoBliskBuild>("octoblisk-compact");
const bool kPoints = registerContender<OctoBliskPoints>("octoblisk-points");

}  // namespace
}  // namespace octoblisk::bench
