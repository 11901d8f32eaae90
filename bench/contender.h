// What a library is asked in the benchmarks: a small interface for each query. A contender implements those
// that its library has, in one file of contenders/, and registers itself there.
#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/rows.h"
#include "scene.h"

namespace octoblisk::bench {

/// A question about one pose.
class PoseQuery {
 public:
  virtual ~PoseQuery() = default;
  /// How many tests the answer takes, and the bytes they read, by name; empty where the library does not
  /// tell.
  virtual std::map<std::string, double> cost(const Pose&) const { return {}; }
};

/// Whether the belt touches the blisk.
class CollideQuery : public PoseQuery {
 public:
  /// If `warm`, the pose is one step from that of the call before.
  virtual bool collides(const Pose& belt_in_blisk, bool warm) = 0;
};

/// Everything that touches.
class ContactsQuery : public PoseQuery {
 public:
  /// The number of pairs of triangles that meet, or of what the library reports in their place.
  virtual std::size_t contacts(const Pose& belt_in_blisk) = 0;
  /// Whether `contacts` counts pairs of triangles, all of them. If not, only "none or some" is compared.
  virtual bool countsPairs() const { return true; }
};

/// The same in a Bullet world: points with depths and normals, for a solver.
class WorldContactsQuery : public PoseQuery {
 public:
  /// The number of contact points of depth 0 or more.
  virtual std::size_t points(const Pose& belt_in_blisk) = 0;
};

/// How near the two come, in a Bullet world: closest points.
class WorldClosestQuery : public PoseQuery {
 public:
  /// The least distance of a point that contactPairTest reports within the threshold, below 0 where it tells
  /// a depth; infinity where it reports none.
  virtual double nearest(const Pose& belt_in_blisk, double threshold) = 0;
};

/// The scene's primitive and a small mesh in a Bullet world.
class WorldPrimitiveQuery {
 public:
  virtual ~WorldPrimitiveQuery() = default;
  /// The least distance of a point that contactPairTest reports, below 0: a depth; infinity where it reports
  /// none.
  virtual double nearest(const Pose& primitive_in_mesh) = 0;
};

/// A ray in a Bullet world.
class WorldRayQuery {
 public:
  virtual ~WorldRayQuery() = default;
  /// The part of the way, 0 to 1, that is gone when a triangle is met; 1 where none is.
  virtual double firstHit(const Segment& way) = 0;
};

/// A ball that is swept through a Bullet world.
class WorldSweepQuery {
 public:
  virtual ~WorldSweepQuery() = default;
  /// As WorldRayQuery's, of the ball's middle.
  virtual double firstTouch(const Segment& way, double radius) = 0;
};

/// A Bullet world in which convex bodies fall onto the blisk.
class WorldStepQuery {
 public:
  static constexpr double kFloor = -30.0;  ///< its height, mm

  virtual ~WorldStepQuery() = default;
  /// Lifts so many bodies to where they start; always the same number.
  virtual void restart(std::size_t bodies) = 0;
  virtual void step() = 0;
  /// Where the bodies are.
  virtual std::vector<Vec3> positions() const = 0;
  /// The contact points on the blisk.
  virtual std::size_t contactsOnBlisk() const = 0;
};

/// A Bullet world in which concave bodies fall onto each other.
class PileQuery {
 public:
  virtual ~PileQuery() = default;
  /// Lifts all bodies to where they start.
  virtual void restart() = 0;
  virtual void step() = 0;
  virtual int bodies() const = 0;
  virtual int fallen() const = 0;    ///< out of the floor's tray
  virtual double depth() const = 0;  ///< of the deepest point of a body in another or in the floor, m
};

/// What a straight way through the blisk meets first.
class RayQuery {
 public:
  virtual ~RayQuery() = default;
  /// The part of the way, 0 to 1, that is gone when a triangle is met; 1 where none is.
  virtual double firstHit(const Segment& way) = 0;
  /// As PoseQuery's.
  virtual std::map<std::string, double> cost(const Segment&) const { return {}; }
};

/// How far apart they are.
class DistanceQuery : public PoseQuery {
 public:
  /// Of two that do not touch. If `warm`, what the call before found may be of use.
  virtual double distance(const Pose& belt_in_blisk, bool warm) = 0;
};

/// The structure that the library keeps beside a mesh.
class BuildQuery {
 public:
  virtual ~BuildQuery() = default;
  /// Builds it anew over the blisk and frees the one before. The mesh is in the library's layout already.
  virtual void build() = 0;
  /// Frees the structure.
  virtual void clear() = 0;
  /// The bytes that the library itself says the structure holds; none: the growth of the heap tells.
  virtual std::optional<std::size_t> ownCount() const { return std::nullopt; }
};

/// The structure fitted to a mesh whose vertices have moved.
class RefitQuery {
 public:
  virtual ~RefitQuery() = default;
  /// To the blisk as it was, or to the bent one.
  virtual void refit(bool bent) = 0;
  /// Whether the belt touches the blisk as it is now.
  virtual bool touches(const Pose& belt_in_blisk) = 0;
};

/// The boxes of a blisk that something must be examined in, once the belt is near: the detection of the
/// paper.
class BoxQuery : public PoseQuery {
 public:
  struct Left {
    std::size_t leaves = 0;  ///< leaf boxes that the belt may be in
    double volume = 0.0;     ///< of them, mm³
  };
  virtual Left left(const Pose& belt_in_blisk) = 0;
  /// Whether any is left: looks no further than the first.
  virtual bool mayTouch(const Pose& belt_in_blisk) = 0;
  /// The volume of the boxes that a detection begins with, mm³.
  virtual double range() const = 0;
};

template <typename Query>
using Maker = std::function<std::unique_ptr<Query>(const Scene&)>;

/// Makes the library's answers to each query on a scene; empty where it has none.
struct Contender {
  std::string name;
  std::string group = {};  ///< empty: of those that all tasks are for; else of one task's own
  Maker<CollideQuery> collide = {};
  Maker<ContactsQuery> contacts = {};
  Maker<WorldContactsQuery> world_contacts = {};
  Maker<WorldClosestQuery> world_closest = {};
  Maker<WorldPrimitiveQuery> world_primitive = {};
  Maker<WorldRayQuery> world_ray = {};
  Maker<WorldSweepQuery> world_sweep = {};
  Maker<WorldStepQuery> world_step = {};
  Maker<PileQuery> pile = {};
  Maker<DistanceQuery> distance = {};
  Maker<RayQuery> ray = {};
  Maker<BuildQuery> build = {};
  Maker<RefitQuery> refit = {};
  Maker<BoxQuery> boxes = {};
};

/// Calls visit with a pointer to each of the makers.
template <typename Visit>
void forEachMaker(Visit&& visit) {
  const auto each = [&](auto... maker) { (visit(maker), ...); };
  each(&Contender::collide, &Contender::contacts, &Contender::world_contacts, &Contender::world_closest,
       &Contender::world_primitive, &Contender::world_ray, &Contender::world_sweep, &Contender::world_step,
       &Contender::pile, &Contender::distance, &Contender::ray, &Contender::build, &Contender::refit,
       &Contender::boxes);
}

/// All of a group that are built in, ours first, the others by name.
const std::vector<Contender>& contenders(const std::string& group = {});

/// A name may come from several files, each with queries of its own.
bool registerContender(Contender contender);

/// Says which version of a library it is, and in which precision it computes.
bool describe(const std::string& name, const std::string& about);

/// What was said, by name.
const std::vector<std::pair<std::string, std::string>>& descriptions();

/// Offers a library's answers to a query, if it is one that they implement.
template <typename Answers, typename Query>
void offer(Maker<Query>& maker) {
  if constexpr (std::derived_from<Answers, Query>) {
    maker = [](const Scene& scene) -> std::unique_ptr<Query> { return std::make_unique<Answers>(scene); };
  }
}

/// Registers a library by its classes of answers, each made from a scene.
template <typename... Answers>
bool registerContender(const std::string& name) {
  Contender contender{.name = name};
  forEachMaker([&](auto maker) { (offer<Answers>(contender.*maker), ...); });
  return registerContender(std::move(contender));
}

}  // namespace octoblisk::bench
