// OctoBlisk with one thing changed at a time, to show what each choice gains. Trees that BuildOptions cannot
// describe are made from the arrays of a tree that it can.
#include <hwy/targets.h>

#include <map>

#include "models/blade_finder.h"
#include "octoblisk_trees.h"
#include "other_trees.h"

namespace octoblisk::bench {
namespace {

/// Makes each tree only once. Copies of a tree share its memory.
MakeTree kept(const MakeTree& make) {
  const auto trees = std::make_shared<std::map<const TriangleMesh*, ClusteredOctree>>();
  return [make, trees](const std::shared_ptr<const TriangleMesh>& mesh) {
    const auto known = trees->find(mesh.get());
    return known != trees->end() ? known->second : trees->emplace(mesh.get(), make(mesh)).first->second;
  };
}

bool registerVariant(const std::string& name, const MakeTree& make) {
  Contender contender = treesOf(name, kept(make));
  contender.group = "ablation";
  return registerContender(std::move(contender));
}

std::string numbered(std::string name, int number) { return name += std::to_string(number); }

/// The paper's partition: the blisk's blades and hub, each in k clusters, in octrees.
MakeTree paperTree(int clusters) {
  return [clusters](const std::shared_ptr<const TriangleMesh>& mesh) {
    BuildOptions options = {.partition = PartitionKind::paper, .clusters = clusters};
    const demos::BladesFound blades = demos::findBlades(*mesh);
    if (blades.count > 0) options.part_of_triangle = blades.blade_of_triangle;  // the belt is one part
    return ClusteredOctree::build(mesh, options);
  };
}

/// Ignores the result of the previous pose.
class ColdDistance final : public DistanceQuery {
 public:
  explicit ColdDistance(const Scene& scene) : warm_(scene, built()) {}
  double distance(const Pose& belt_in_blisk, bool) override { return warm_.distance(belt_in_blisk, false); }

 private:
  OctoBliskDistance warm_;
};

/// While it exists, the library uses its code for any x86-64 processor, one number at a time. Detecting the
/// processor's instruction sets anew, as tests do, would take longer than a query.
class NoSimd {
 public:
  NoSimd() { hwy::GetChosenTarget().Update(HWY_STATIC_TARGET); }
  ~NoSimd() {
    static const auto all = hwy::SupportedTargets();
    hwy::GetChosenTarget().Update(all);
  }
  NoSimd(const NoSimd&) = delete;
  NoSimd& operator=(const NoSimd&) = delete;
};

class PlainCollide final : public CollideQuery {
 public:
  explicit PlainCollide(const Scene& scene) : query_(scene, built()) {}
  bool collides(const Pose& belt_in_blisk, bool warm) override {
    const NoSimd only;
    return query_.collides(belt_in_blisk, warm);
  }

 private:
  OctoBliskCollide query_;
};

class PlainContacts final : public ContactsQuery {
 public:
  explicit PlainContacts(const Scene& scene) : query_(scene, built()) {}
  std::size_t contacts(const Pose& belt_in_blisk) override {
    const NoSimd only;
    return query_.contacts(belt_in_blisk);
  }

 private:
  OctoBliskPairs query_;
};

class PlainDistance final : public DistanceQuery {
 public:
  explicit PlainDistance(const Scene& scene) : query_(scene, built()) {}
  double distance(const Pose& belt_in_blisk, bool warm) override {
    const NoSimd only;
    return query_.distance(belt_in_blisk, warm);
  }

 private:
  OctoBliskDistance query_;
};

class PlainRays final : public RayQuery {
 public:
  explicit PlainRays(const Scene& scene) : query_(scene, built()) {}
  double firstHit(const Segment& segment) override {
    const NoSimd only;
    return query_.firstHit(segment);
  }

 private:
  OctoBliskRays query_;
};

template <typename Answers, typename Query>
Maker<Query> made() {
  return [](const Scene& scene) -> std::unique_ptr<Query> { return std::make_unique<Answers>(scene); };
}

const bool kRegistered = [] {
  registerVariant(kOurs, built());
  registerVariant("fast-build", built({.quality = BuildQuality::low}));
  registerVariant("compact", built({.storage = Storage::compact}));
  for (const int capacity : {1, 2, 4})
    registerVariant(numbered("leaf-", capacity), built({.leaf_capacity = capacity}));
  for (int k = 1; k <= 8; ++k) registerVariant(numbered("paper-k", k), paperTree(k));
  registerVariant("axis-aligned", axisAligned(Aligned::all));
  registerVariant("axis-aligned-leaves", axisAligned(Aligned::leaves));
  registerVariant("axis-aligned-inner", axisAligned(Aligned::inner));
  registerVariant("two-a-node", narrowed(2));
  registerVariant("four-a-node", narrowed(4));
  registerContender({.name = "no-coherence",
                     .group = "ablation",
                     .collide = answers<OctoBliskCold, CollideQuery>(built()),
                     .distance = made<ColdDistance, DistanceQuery>()});
  return registerContender({.name = "no-simd",
                            .group = "ablation",
                            .collide = made<PlainCollide, CollideQuery>(),
                            .contacts = made<PlainContacts, ContactsQuery>(),
                            .distance = made<PlainDistance, DistanceQuery>(),
                            .ray = made<PlainRays, RayQuery>()});
}();

}  // namespace
}  // namespace octoblisk::bench
