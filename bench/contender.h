// The queries of the benchmarks: one small interface for each. A contender implements the queries that its
// library supports, in one file of contenders/, and registers itself there.
#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "report/rows.h"
#include "scene.h"

namespace octoblisk::bench {

/// A query about one pose.
class PoseQuery {
 public:
  virtual ~PoseQuery() = default;
  /// The number of tests that the answer takes and the bytes that they read, by name. Empty if the library
  /// does not report them.
  virtual std::map<std::string, double> cost(const Pose&) const { return {}; }
};

/// Whether the belt touches the blisk.
class CollideQuery : public PoseQuery {
 public:
  /// If `warm`, the pose is one step from that of the call before.
  virtual bool collides(const Pose& belt_in_blisk, bool warm) = 0;
};

/// All contacts.
class ContactsQuery : public PoseQuery {
 public:
  /// The number of triangle pairs that touch, or of whatever the library reports instead.
  virtual std::size_t contacts(const Pose& belt_in_blisk) = 0;
  /// Whether `contacts` counts all triangle pairs. If not, only "none or some" is compared.
  virtual bool countsPairs() const { return true; }
};

/// All contacts in a Bullet world: points with depths and normals, for a solver.
class WorldContactsQuery : public PoseQuery {
 public:
  /// The number of contact points of depth 0 or more.
  virtual std::size_t points(const Pose& belt_in_blisk) = 0;
};

/// The closest points in a Bullet world.
class WorldClosestQuery : public PoseQuery {
 public:
  /// The least distance of the points that contactPairTest reports within the threshold. A depth is a
  /// distance below 0. Infinity if it reports no point.
  virtual double nearest(const Pose& belt_in_blisk, double threshold) = 0;
};

/// The scene's primitive and a small mesh in a Bullet world.
class WorldPrimitiveQuery {
 public:
  virtual ~WorldPrimitiveQuery() = default;
  /// The least distance of the points that contactPairTest reports. A depth is a distance below 0. Infinity
  /// if it reports no point.
  virtual double nearest(const Pose& primitive_in_mesh) = 0;
};

/// A ray in a Bullet world.
class WorldRayQuery {
 public:
  virtual ~WorldRayQuery() = default;
  /// The fraction of the segment, 0 to 1, before the first hit; 1 if it hits no triangle.
  virtual double firstHit(const Segment& segment) = 0;
};

/// A ball swept through a Bullet world.
class WorldSweepQuery {
 public:
  virtual ~WorldSweepQuery() = default;
  /// Like WorldRayQuery::firstHit, for the ball's centre.
  virtual double firstTouch(const Segment& segment, double radius) = 0;
};

/// A Bullet world in which convex bodies fall onto the blisk.
class WorldStepQuery {
 public:
  static constexpr double kFloor = -30.0;  ///< height of the floor, mm

  virtual ~WorldStepQuery() = default;
  /// Puts `bodies` bodies at their start. Every call must pass the same number.
  virtual void restart(std::size_t bodies) = 0;
  virtual void step() = 0;
  virtual std::vector<Vec3> positions() const = 0;
  /// The number of contact points on the blisk.
  virtual std::size_t contactsOnBlisk() const = 0;
};

/// A Bullet world in which concave bodies fall onto each other.
class PileQuery {
 public:
  virtual ~PileQuery() = default;
  /// Puts all bodies at their start.
  virtual void restart() = 0;
  virtual void step() = 0;
  virtual int bodies() const = 0;
  virtual int fallen() const = 0;    ///< bodies that left the floor's tray
  virtual double depth() const = 0;  ///< greatest penetration depth of a body in another or in the floor, m
};

/// A world of Bullet or ODE in which a nut runs down a bolt, without friction.
class AssemblyQuery {
 public:
  virtual ~AssemblyQuery() = default;
  /// Puts the nut at its start.
  virtual void restart() = 0;
  virtual void step() = 0;
  virtual double sunk() const = 0;          ///< how far the nut has run down, mm
  virtual double expectedSunk() const = 0;  ///< by the closed form, mm
  virtual double turns() const = 0;         ///< of the nut in the sense in which it runs down
  virtual double offHelix() const = 0;      ///< greatest distance from the helix since the start, mm
  virtual double play() const = 0;          ///< along the axis, mm
};

/// The first triangle that a segment through the blisk hits.
class RayQuery {
 public:
  virtual ~RayQuery() = default;
  /// The fraction of the segment, 0 to 1, before the first hit; 1 if it hits no triangle.
  virtual double firstHit(const Segment& segment) = 0;
  /// The same for many segments.
  virtual void firstHits(std::span<const Segment> segments, std::span<double> fractions) {
    std::ranges::transform(segments, fractions.begin(),
                           [this](const Segment& segment) { return firstHit(segment); });
  }
  /// Like PoseQuery::cost.
  virtual std::map<std::string, double> cost(const Segment&) const { return {}; }
};

/// The distance of belt and blisk.
class DistanceQuery : public PoseQuery {
 public:
  /// The belt does not touch the blisk. If `warm`, the answer to the previous call may help.
  virtual double distance(const Pose& belt_in_blisk, bool warm) = 0;
};

/// The structure that the library keeps in addition to a mesh.
class BuildQuery {
 public:
  virtual ~BuildQuery() = default;
  /// Frees the previous structure and builds a new one over the blisk. The mesh is already in the library's
  /// layout.
  virtual void build() = 0;
  /// Frees the structure.
  virtual void clear() = 0;
  /// The bytes that the structure holds, if the library itself reports them. Otherwise the growth of the heap
  /// is measured.
  virtual std::optional<std::size_t> ownCount() const { return std::nullopt; }
};

/// The structure fitted to a mesh whose vertices have moved.
class RefitQuery {
 public:
  virtual ~RefitQuery() = default;
  /// Fits the structure to the bent blisk, or to the original one.
  virtual void refit(bool bent) = 0;
  /// Whether the belt touches the blisk in its current shape.
  virtual bool touches(const Pose& belt_in_blisk) = 0;
};

/// The boxes of a blisk that need a closer test when the belt is near: the paper's detection.
class BoxQuery : public PoseQuery {
 public:
  struct Left {
    std::size_t leaves = 0;  ///< leaf boxes that the belt may be in
    double volume = 0.0;     ///< of these boxes, mm³
  };
  virtual Left left(const Pose& belt_in_blisk) = 0;
  /// Whether any box is left. Stops at the first one.
  virtual bool mayTouch(const Pose& belt_in_blisk) = 0;
  /// The volume of the boxes that a detection starts with, mm³.
  virtual double range() const = 0;
};

template <typename Query>
using Maker = std::function<std::unique_ptr<Query>(const Scene&)>;

/// Makes the library's implementation of each query for a scene. A maker is empty if the library does not
/// support the query.
struct Contender {
  std::string name;
  std::string group = {};  ///< empty: takes part in the general tasks; otherwise only in tasks of this group
  Maker<CollideQuery> collide = {};
  Maker<ContactsQuery> contacts = {};
  Maker<WorldContactsQuery> world_contacts = {};
  Maker<WorldClosestQuery> world_closest = {};
  Maker<WorldPrimitiveQuery> world_primitive = {};
  Maker<WorldRayQuery> world_ray = {};
  Maker<WorldSweepQuery> world_sweep = {};
  Maker<WorldStepQuery> world_step = {};
  Maker<PileQuery> pile = {};
  Maker<AssemblyQuery> assembly = {};
  Maker<DistanceQuery> distance = {};
  Maker<RayQuery> ray = {};
  Maker<BuildQuery> build = {};
  Maker<RefitQuery> refit = {};
  Maker<BoxQuery> boxes = {};
};

/// Calls `visit` with a pointer to each maker.
template <typename Visit>
void forEachMaker(Visit&& visit) {
  const auto each = [&](auto... maker) { (visit(maker), ...); };
  each(&Contender::collide, &Contender::contacts, &Contender::world_contacts, &Contender::world_closest,
       &Contender::world_primitive, &Contender::world_ray, &Contender::world_sweep, &Contender::world_step,
       &Contender::pile, &Contender::assembly, &Contender::distance, &Contender::ray, &Contender::build,
       &Contender::refit, &Contender::boxes);
}

/// All contenders of a group in this build: ours first, the others by name.
const std::vector<Contender>& contenders(const std::string& group = {});

/// Several files may register the same name, each with different queries.
bool registerContender(Contender contender);

/// Records a library's version and the precision it computes in.
bool describe(const std::string& name, const std::string& about);

/// All recorded descriptions, by name.
const std::vector<std::pair<std::string, std::string>>& descriptions();

/// Sets the maker of a query if `Answers` implements that query.
template <typename Answers, typename Query>
void offer(Maker<Query>& maker) {
  if constexpr (std::derived_from<Answers, Query>) {
    maker = [](const Scene& scene) -> std::unique_ptr<Query> { return std::make_unique<Answers>(scene); };
  }
}

/// Registers a library by the classes that implement its queries. Each is constructed from a scene.
template <typename... Answers>
bool registerContender(const std::string& name) {
  Contender contender{.name = name};
  forEachMaker([&](auto maker) { (offer<Answers>(contender.*maker), ...); });
  return registerContender(std::move(contender));
}

}  // namespace octoblisk::bench
