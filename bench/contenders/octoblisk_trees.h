// OctoBlisk's queries on any trees, for the contenders and for the variants of the ablation.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contender.h"
#include "octoblisk/build_options.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "octoblisk/distance.h"
#include "octoblisk/path_query.h"
#include "octoblisk/raycast.h"
#include "query_cost.h"

namespace octoblisk::bench {

/// Makes the tree over a mesh of a scene, blisk or belt.
using MakeTree = std::function<ClusteredOctree(const std::shared_ptr<const TriangleMesh>&)>;

inline MakeTree built(const BuildOptions& options = {}) {
  return [options](const std::shared_ptr<const TriangleMesh>& mesh) {
    return ClusteredOctree::build(mesh, options);
  };
}

template <typename... Trees>
std::map<std::string, double> named(const QueryCost& cost, const Trees&... trees) {
  return {{"box_tests", static_cast<double>(cost.box_tests)},
          {"leaf_pairs", static_cast<double>(cost.leaf_pairs)},
          {"triangle_tests", static_cast<double>(cost.triangle_tests)},
          {"exact_tests", static_cast<double>(cost.exact_tests)},
          {"bytes", static_cast<double>(cost.bytes(trees...))}};
}

/// The trees of blisk and belt.
struct Trees {
  Trees(const Scene& scene, const MakeTree& make) : blisk(make(scene.blisk)), belt(make(scene.belt)) {}

  ClusteredOctree blisk, belt;
};

/// Uses the path query on a path, and single queries otherwise.
class OctoBliskCollide final : public CollideQuery {
 public:
  OctoBliskCollide(const Scene& scene, const MakeTree& make)
      : trees_(scene, make), along_path_(trees_.blisk, trees_.belt) {}

  bool collides(const Pose& belt_in_blisk, bool warm) override {
    return warm ? along_path_.collide(belt_in_blisk).has_value()
                : collide(trees_.blisk, trees_.belt, belt_in_blisk).has_value();
  }

 private:
  Trees trees_;
  PathQuery along_path_;
};

/// Answers each pose independently, even on a path.
class OctoBliskCold final : public CollideQuery {
 public:
  OctoBliskCold(const Scene& scene, const MakeTree& make) : trees_(scene, make) {}

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
  OctoBliskPairs(const Scene& scene, const MakeTree& make) : trees_(scene, make) {}

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
  OctoBliskDistance(const Scene& scene, const MakeTree& make) : trees_(scene, make) {}

  double distance(const Pose& belt_in_blisk, bool warm) override {
    DistanceOptions options;
    if (warm) options.hint = nearest_;
    const Clearance clearance = octoblisk::distance(trees_.blisk, trees_.belt, belt_in_blisk, options);
    nearest_ = clearance.triangles();
    return clearance.distance;
  }
  std::map<std::string, double> cost(const Pose& belt_in_blisk) const override {
    return named(costOfDistance(trees_.blisk, trees_.belt, belt_in_blisk), trees_.blisk, trees_.belt);
  }

 private:
  Trees trees_;
  TrianglePair nearest_;  // of the previous call
};

class OctoBliskRays : public RayQuery {
 public:
  OctoBliskRays(const Scene& scene, const MakeTree& make) : blisk_(make(scene.blisk)) {}

  double firstHit(const Segment& segment) override {
    const std::optional<RayHit> hit = closestHit(blisk_, along(segment));
    return hit ? hit->t : 1.0;
  }
  std::map<std::string, double> cost(const Segment& segment) const override {
    return named(costOfClosestHit(blisk_, along(segment)), blisk_);
  }

 protected:
  static Ray along(const Segment& segment) {
    Ray ray;
    ray.origin = segment.from;
    ray.direction = segment.to - segment.from;
    ray.t_max = 1.0;
    return ray;
  }

  ClusteredOctree blisk_;
};

template <typename Answers, typename Query>
Maker<Query> answers(const MakeTree& make) {
  return
      [make](const Scene& scene) -> std::unique_ptr<Query> { return std::make_unique<Answers>(scene, make); };
}

/// All queries on trees from `make`.
inline Contender treesOf(const std::string& name, const MakeTree& make) {
  return {.name = name,
          .collide = answers<OctoBliskCollide, CollideQuery>(make),
          .contacts = answers<OctoBliskPairs, ContactsQuery>(make),
          .distance = answers<OctoBliskDistance, DistanceQuery>(make),
          .ray = answers<OctoBliskRays, RayQuery>(make)};
}

}  // namespace octoblisk::bench
