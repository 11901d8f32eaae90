// OctoBlisk: the clustered octree.
#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "octoblisk/batch.h"
#include "octoblisk_trees.h"

namespace octoblisk::bench {
namespace {

/// With points, normals and depths.
class OctoBliskPoints final : public ContactsQuery {
 public:
  explicit OctoBliskPoints(const Scene& scene) : trees_(scene, built()) {}

  std::size_t contacts(const Pose& belt_in_blisk) override {
    octoblisk::contacts(trees_.blisk, trees_.belt, belt_in_blisk, 0.0, found_);
    return found_.size();
  }

 private:
  Trees trees_;
  std::vector<Contact> found_;
};

class OctoBliskBuild final : public BuildQuery {
 public:
  OctoBliskBuild(const Scene& scene, const BuildOptions& options) : mesh_(scene.blisk), options_(options) {}

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

class OctoBliskRefit final : public RefitQuery {
 public:
  explicit OctoBliskRefit(const Scene& scene)
      : mesh_(scene.blisk), bent_(bench::bent(*scene.blisk)), trees_(scene, built()) {}

  void refit(bool bent) override { trees_.blisk = std::move(trees_.blisk).refitted(bent ? bent_ : mesh_, 1); }
  bool touches(const Pose& belt_in_blisk) override {
    return collide(trees_.blisk, trees_.belt, belt_in_blisk).has_value();
  }

 private:
  std::shared_ptr<const TriangleMesh> mesh_, bent_;
  Trees trees_;
};

/// Casts many rays in one call.
class OctoBliskManyRays final : public OctoBliskRays {
 public:
  using OctoBliskRays::OctoBliskRays;

  void firstHits(std::span<const Segment> segments, std::span<double> fractions) override {
    rays_.resize(segments.size());
    std::ranges::transform(segments, rays_.begin(), along);
    const auto fraction = [](const std::optional<RayHit>& hit) { return hit ? hit->t : 1.0; };
    std::ranges::transform(closestHitAll(blisk_, rays_, 1), fractions.begin(), fraction);
  }

 private:
  std::vector<Ray> rays_;
};

/// Registers all queries on trees built with these options, and the build itself.
bool registerTrees(const std::string& name, const BuildOptions& options) {
  Contender contender = treesOf(name, built(options));
  contender.build = [options](const Scene& scene) {
    return std::make_unique<OctoBliskBuild>(scene, options);
  };
  return registerContender(std::move(contender));
}

/// Registers only the build.
bool registerBuild(const std::string& name, const BuildOptions& options) {
  return registerContender({.name = name, .build = [options](const Scene& scene) {
                              return std::make_unique<OctoBliskBuild>(scene, options);
                            }});
}

const bool kRegistered = registerTrees(kOurs, {}) &&
                         describe(kOurs, "single precision filters, exact verdicts of double vertices");
const bool kRefit = registerContender<OctoBliskRefit>(kOurs);
const bool kCompact = registerTrees("octoblisk-compact", {.storage = Storage::compact});
const bool kOneThread = registerBuild("octoblisk-1-thread", {.threads = 1});
const bool kFast = registerBuild("octoblisk-fast", {.quality = BuildQuality::low});
const bool kCold =
    registerContender({.name = "octoblisk-cold", .collide = answers<OctoBliskCold, CollideQuery>(built())});
const bool kManyRays =
    registerContender({.name = "octoblisk-many", .ray = answers<OctoBliskManyRays, RayQuery>(built())});
const bool kPoints = registerContender<OctoBliskPoints>("octoblisk-points");
// The lower bound is compared with this contender: it answers each pose independently.
const bool kLimit = [] {
  Contender contender = treesOf(kOurs, built());
  contender.group = "limit";
  contender.collide = answers<OctoBliskCold, CollideQuery>(built());
  return registerContender(std::move(contender));
}();

}  // namespace
}  // namespace octoblisk::bench
