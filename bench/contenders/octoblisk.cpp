// Our own: the clustered octree.
#include <map>
#include <optional>
#include <string>

#include "contender.h"
#include "octoblisk/build_options.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "octoblisk/distance.h"
#include "octoblisk/path_query.h"
#include "octoblisk/query_cost.h"
#include "octoblisk/raycast.h"

namespace octoblisk::bench {
namespace {

template <typename... Trees>
std::map<std::string, double> named(const QueryCost& cost, const Trees&... trees) {
  return {{"box_tests", static_cast<double>(cost.box_tests)},
          {"leaf_pairs", static_cast<double>(cost.leaf_pairs)},
          {"triangle_tests", static_cast<double>(cost.triangle_tests)},
          {"exact_tests", static_cast<double>(cost.exact_tests)},
          {"bytes", static_cast<double>(cost.bytes(trees...))}};
}

/// The two trees that all questions are about.
struct Trees {
  Trees(const Scene& scene, const BuildOptions& options)
      : blisk(ClusteredOctree::build(scene.blisk, options)),
        belt(ClusteredOctree::build(scene.belt, options)) {}

  ClusteredOctree blisk, belt;
};

/// Along a path by the query made for paths, else pose by pose.
class OctoBliskCollide final : public CollideQuery {
 public:
  OctoBliskCollide(const Scene& scene, const BuildOptions& options)
      : trees_(scene, options), along_path_(trees_.blisk, trees_.belt) {}

  bool collides(const Pose& belt_in_blisk, bool warm) override {
    return warm ? along_path_.collide(belt_in_blisk).has_value()
                : collide(trees_.blisk, trees_.belt, belt_in_blisk).has_value();
  }

 private:
  Trees trees_;
  PathQuery along_path_;
};

/// Each pose by itself, on a path as well.
class OctoBliskCold final : public CollideQuery {
 public:
  explicit OctoBliskCold(const Scene& scene) : trees_(scene, {}) {}

  bool collides(const Pose& belt_in_blisk, bool) override {
    return collide(trees_.blisk, trees_.belt, belt_in_blisk).has_value();
  }
  std::map<std::string, double> cost(const Pose& belt_in_blisk) const override {
    return named(costOfCollide(trees_.blisk, trees_.belt, belt_in_blisk), trees_.blisk, trees_.belt);
  }

 private:
  Trees trees_;
};

class OctoBliskPairs final : public ContactsQuery {
 public:
  OctoBliskPairs(const Scene& scene, const BuildOptions& options) : trees_(scene, options) {}

  std::size_t contacts(const Pose& belt_in_blisk) override {
    touchingPairs(trees_.blisk, trees_.belt, belt_in_blisk, pairs_);
    return pairs_.size();
  }
  std::map<std::string, double> cost(const Pose& belt_in_blisk) const override {
    return named(costOfTouchingPairs(trees_.blisk, trees_.belt, belt_in_blisk), trees_.blisk, trees_.belt);
  }

 private:
  Trees trees_;
  std::vector<TrianglePair> pairs_;
};

class OctoBliskDistance final : public DistanceQuery {
 public:
  OctoBliskDistance(const Scene& scene, const BuildOptions& options) : trees_(scene, options) {}

  double distance(const Pose& belt_in_blisk, bool warm) override {
    DistanceOptions options;
    if (warm) options.hint = nearest_;
    const Clearance clearance = octoblisk::distance(trees_.blisk, trees_.belt, belt_in_blisk, options);
    nearest_ = {clearance.triangle_a, clearance.triangle_b};
    return clearance.distance;
  }
  std::map<std::string, double> cost(const Pose& belt_in_blisk) const override {
    return named(costOfDistance(trees_.blisk, trees_.belt, belt_in_blisk), trees_.blisk, trees_.belt);
  }

 private:
  Trees trees_;
  TrianglePair nearest_;  // of the call before
};

/// With points, normals and depths.
class OctoBliskPoints final : public ContactsQuery {
 public:
  explicit OctoBliskPoints(const Scene& scene) : trees_(scene, {}) {}

  std::size_t contacts(const Pose& belt_in_blisk) override {
    octoblisk::contacts(trees_.blisk, trees_.belt, belt_in_blisk, 0.0, found_);
    return found_.size();
  }

 private:
  Trees trees_;
  std::vector<Contact> found_;
};

class OctoBliskRays final : public RayQuery {
 public:
  OctoBliskRays(const Scene& scene, const BuildOptions& options)
      : blisk_(ClusteredOctree::build(scene.blisk, options)) {}

  double firstHit(const Segment& way) override {
    const std::optional<RayHit> hit = closestHit(blisk_, along(way));
    return hit ? hit->t : 1.0;
  }
  std::map<std::string, double> cost(const Segment& way) const override {
    return named(costOfClosestHit(blisk_, along(way)), blisk_);
  }

 private:
  static Ray along(const Segment& way) {
    Ray ray;
    ray.origin = way.from;
    ray.direction = way.to - way.from;
    ray.t_max = 1.0;
    return ray;
  }

  ClusteredOctree blisk_;
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

template <typename Answers, typename Query>
Maker<Query> answers(const BuildOptions& options) {
  return [options](const Scene& scene) -> std::unique_ptr<Query> {
    return std::make_unique<Answers>(scene, options);
  };
}

/// Registers all answers of trees that are built by these options.
bool registerTrees(const std::string& name, const BuildOptions& options) {
  return registerContender({.name = name,
                            .collide = answers<OctoBliskCollide, CollideQuery>(options),
                            .contacts = answers<OctoBliskPairs, ContactsQuery>(options),
                            .distance = answers<OctoBliskDistance, DistanceQuery>(options),
                            .ray = answers<OctoBliskRays, RayQuery>(options),
                            .build = answers<OctoBliskBuild, BuildQuery>(options)});
}

/// Registers their build alone.
bool registerBuild(const std::string& name, const BuildOptions& options) {
  return registerContender({.name = name, .build = answers<OctoBliskBuild, BuildQuery>(options)});
}

const bool kRegistered = registerTrees(kOurs, {});
const bool kCompact = registerTrees("octoblisk-compact", {.storage = Storage::compact});
const bool kOneThread = registerBuild("octoblisk-1-thread", {.threads = 1});
const bool kFast = registerBuild("octoblisk-fast", {.quality = BuildQuality::fast});
const bool kCold = registerContender<OctoBliskCold>("octoblisk-cold");
const bool kPoints = registerContender<OctoBliskPoints>("octoblisk-points");

}  // namespace
}  // namespace octoblisk::bench
