// What a library is asked in the benchmarks: a small interface for each query. A contender implements those
// that its library has, in one file of contenders/, and registers itself there.
#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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

/// A Bullet world in which bodies fall onto the blisk.
class WorldStepQuery {
 public:
  static constexpr double kFloor = -30.0;  ///< its height, mm

  virtual ~WorldStepQuery() = default;
  /// Lifts all bodies to where they start.
  virtual void restart() = 0;
  virtual void step() = 0;
  /// Where the bodies are.
  virtual std::vector<Vec3> positions() const = 0;
  /// The contact points on the blisk.
  virtual std::size_t contactsOnBlisk() const = 0;
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

template <typename Query>
using Maker = std::function<std::unique_ptr<Query>(const Scene&)>;

/// Makes the library's answers to each query on a scene; empty where it has none.
struct Contender {
  std::string name;
  Maker<CollideQuery> collide = {};
  Maker<ContactsQuery> contacts = {};
  Maker<WorldContactsQuery> world_contacts = {};
  Maker<WorldStepQuery> world_step = {};
  Maker<DistanceQuery> distance = {};
  Maker<RayQuery> ray = {};
  Maker<BuildQuery> build = {};
};

/// The one that all others are compared with.
inline constexpr const char* kOurs = "octoblisk";

/// All that are built in, ours first, the others by name.
const std::vector<Contender>& contenders();

/// A name may come from several files, each with queries of its own.
bool registerContender(Contender contender);

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
  (offer<Answers>(contender.collide), ...);
  (offer<Answers>(contender.contacts), ...);
  (offer<Answers>(contender.world_contacts), ...);
  (offer<Answers>(contender.world_step), ...);
  (offer<Answers>(contender.distance), ...);
  (offer<Answers>(contender.ray), ...);
  (offer<Answers>(contender.build), ...);
  return registerContender(std::move(contender));
}

}  // namespace octoblisk::bench
