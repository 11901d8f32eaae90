// Compares the contacts of worlds with ClusteredOctreeBroadphase and with btDbvtBroadphase. Bodies of all
// kinds move, appear, disappear and change their shapes. With this seed, every contact is the same to the
// last bit. With others it need not be: a patch prefers the points that it had in the step before, and a pair
// may have had its first step later in the one world.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "cluster_test.h"
#include "plugin/broadphase_worlds.h"
#include "plugin/mixed_shapes.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::StockWorld;
using testing::TightWorld;
using testing::uniform;

/// A contact point without the solver's data.
struct TouchPoint {
  std::pair<int, int> bodies;
  std::array<double, 10> place;  ///< on the one body, on the other, normal, distance
  std::array<int, 4> triangles;  ///< part and index on either

  auto operator<=>(const TouchPoint&) const = default;
};

/// Leaves out the contacts of two sleepers. Bullet does not ask for them, but keeps the old ones as long as
/// the pair, and the two worlds may have found the pair in different steps.
template <typename World>
std::vector<TouchPoint> touchPoints(World& world) {
  std::vector<TouchPoint> found;
  for (int m = 0; m < world.dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *world.dispatcher.getManifoldByIndexInternal(m);
    const btCollisionObject &first = *manifold.getBody0(), &second = *manifold.getBody1();
    if (!first.isActive() && !second.isActive()) continue;
    if (!testing::boxesOverlap(first.getBroadphaseHandle(), second.getBroadphaseHandle())) continue;
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& point = manifold.getContactPoint(p);
      const Vec3 a = fromBullet(point.m_positionWorldOnA), b = fromBullet(point.m_positionWorldOnB),
                 n = fromBullet(point.m_normalWorldOnB);
      found.push_back(
          {{first.getUserIndex(), second.getUserIndex()},
           {a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), n.x(), n.y(), n.z(), double(point.getDistance())},
           {point.m_partId0, point.m_index0, point.m_partId1, point.m_index1}});
    }
  }
  std::ranges::sort(found);
  return found;
}

/// The numbers of the objects in a ghost, except those whose boxes no longer overlap.
std::vector<int> numbersIn(const btGhostObject& ghost) {
  std::vector<int> numbers;
  for (int i = 0; i < ghost.getNumOverlappingObjects(); ++i) {
    const btCollisionObject& object = *ghost.getOverlappingObject(i);
    if (testing::boxesOverlap(ghost.getBroadphaseHandle(), object.getBroadphaseHandle()))
      numbers.push_back(object.getUserIndex());
  }
  std::ranges::sort(numbers);
  return numbers;
}

struct Life {
  const char* name;
  int bodies, steps;
  int detail;                      ///< of the shapes
  double half_size;                ///< of the cube in which the bodies start
  double least_speed, most_speed;  ///< mesh units and radians per step

  friend void PrintTo(const Life& life, std::ostream* out) { *out << life.name; }
};

/// The same sequence of changes in two worlds.
class Twins {
 public:
  explicit Twins(const Life& life) : life_(life), shapes_(life.detail) {
    both([&](auto& world) {
      world.broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&ghost_pairs_);
      world.objects.resize(std::size_t(life_.bodies));
    });
    movers_.resize(std::size_t(life_.bodies));
    for (std::size_t i = 0; i < movers_.size(); ++i) replace(i);
  }

  ~Twins() { gContactBreakingThreshold = kBreakingThreshold; }
  Twins(const Twins&) = delete;
  Twins& operator=(const Twins&) = delete;

  StockWorld& stock() { return stock_; }
  TightWorld& tight() { return tight_; }

  /// Moves and changes the bodies, and finds their contacts.
  void step() {
    changeThresholds();
    if (random_() % 20 == 0) shapes_.change(random_);
    for (std::size_t i = 0; i < movers_.size(); ++i) {
      move(i);
      if (random_() % (movers_[i].is_there ? 400 : 40) == 0) toggle(i);
      if (random_() % 30 == 0) {  // puts to sleep or wakes; sleepers move and change like all others
        const int state = random_() % 3 == 0 ? ISLAND_SLEEPING : ACTIVE_TAG;
        both([&](auto& world) { world.objects[i]->forceActivationState(state); });
      }
      if (random_() % 600 == 0) {
        btCollisionShape& shape = shapes_.any(random_);
        both([&](auto& world) { world.reshape(*world.objects[i], shape); });
      }
    }
    if (random_() % 10 == 0) replace(random_() % movers_.size());
    both([](auto& world) { world.world.performDiscreteCollisionDetection(); });
  }

  /// Whether ghosts overlap the same objects in both worlds. Counts these objects.
  bool ghostsAgree(std::size_t& overlaps) const {
    for (std::size_t i = 0; i < movers_.size(); ++i) {
      const auto* ghost = dynamic_cast<const btGhostObject*>(stock_.objects[i].get());
      if (!ghost || !movers_[i].is_there) continue;
      const std::vector<int> numbers = numbersIn(*ghost);
      overlaps += numbers.size();
      if (numbersIn(dynamic_cast<const btGhostObject&>(*tight_.objects[i])) != numbers) return false;
    }
    return true;
  }

 private:
  struct Mover {
    Pose pose;
    Vec3 velocity, spin_axis;
    double spin;
    int group, mask;
    bool is_there;
  };

  template <typename Change>
  void both(const Change& change) {
    change(stock_);
    change(tight_);
  }

  /// Our algorithms keep the contacts of bodies that hardly move. These contacts depend on the step in which
  /// they were found, and the two worlds may ask for a pair in different steps. If the contact breaking
  /// threshold changes a little, all contacts are found again.
  void changeThresholds() {
    const btScalar factor = is_odd_step_ ? btScalar(1 / 1.001) : btScalar(1.001);
    is_odd_step_ = !is_odd_step_;
    gContactBreakingThreshold *= factor;
    shapes_.scaleThresholds(factor);
  }

  /// Puts a new body in the place of the old one, if there was one.
  void replace(std::size_t i) {
    using Filter = btBroadphaseProxy;
    const double speed =
        life_.least_speed * std::pow(life_.most_speed / life_.least_speed, uniform(random_, 0, 1));
    Mover& mover = movers_[i];
    mover = {testing::randomPose(random_, life_.half_size),
             testing::randomPoint(random_, speed),
             testing::randomPoint(random_, 1).normalized(),
             uniform(random_, -speed, speed),
             Filter::DefaultFilter,
             Filter::AllFilter,
             true};
    btCollisionShape& shape = shapes_.any(random_);
    const std::uint64_t kind = random_() % 20;
    const bool is_ghost = kind == 0, is_kinematic = kind >= 1 && kind < 6, is_static = kind >= 6 && kind < 8;
    if (is_kinematic || is_static) {  // filters as Bullet uses for static bodies and the plugin for tools
      mover.group = is_static ? Filter::StaticFilter : Filter::KinematicFilter;
      mover.mask = Filter::AllFilter ^ mover.group;
    }
    both([&](auto& world) {
      std::unique_ptr<btCollisionObject>& object = world.objects[i];
      if (object && object->getBroadphaseHandle()) world.world.removeCollisionObject(object.get());
      if (is_ghost) {
        object = std::make_unique<btPairCachingGhostObject>();
        object->setCollisionShape(&shape);
      } else {
        object = std::make_unique<btRigidBody>(btScalar(is_kinematic || is_static ? 0 : 1), nullptr, &shape);
        if (is_kinematic) object->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
      }
      object->setUserIndex(int(i));
      place(*object, mover.pose);
      world.world.addCollisionObject(object.get(), mover.group, mover.mask);
    });
  }

  /// A body's box also contains the position that Bullet interpolates from.
  static void place(btCollisionObject& object, const Pose& pose) {
    object.setWorldTransform(toBullet(pose));
    object.setInterpolationWorldTransform(toBullet(pose));
  }

  void move(std::size_t i) {
    Mover& mover = movers_[i];
    mover.pose.translation += mover.velocity;
    mover.pose.rotation = Eigen::AngleAxisd(mover.spin, mover.spin_axis) * mover.pose.rotation;
    const bool is_far = mover.pose.translation.cwiseAbs().maxCoeff() > life_.half_size;
    if (is_far && mover.velocity.dot(mover.pose.translation) > 0) mover.velocity = -mover.velocity;
    both([&](auto& world) { place(*world.objects[i], mover.pose); });
  }

  void toggle(std::size_t i) {
    Mover& mover = movers_[i];
    mover.is_there = !mover.is_there;
    both([&](auto& world) {
      btCollisionObject* object = world.objects[i].get();
      if (mover.is_there) {
        world.world.addCollisionObject(object, mover.group, mover.mask);
      } else {
        world.world.removeCollisionObject(object);
      }
    });
  }

  static constexpr btScalar kBreakingThreshold = btScalar(0.02);  // Bullet's default

  const Life life_;
  bool is_odd_step_ = false;
  std::mt19937_64 random_{74};
  testing::MixedShapes shapes_;
  btGhostPairCallback ghost_pairs_;
  std::vector<Mover> movers_;
  StockWorld stock_;
  TightWorld tight_;
};

/// The number of pairs that clusters decide.
template <typename World>
std::size_t pairsOfClusters(World& world) {
  const btBroadphasePairArray& pairs = world.broadphase.getOverlappingPairCache()->getOverlappingPairArray();
  detail::ClusterTest clusters(ClusteredOctreeBroadphase::kDefaultDepth);
  std::size_t count = 0;
  for (int i = 0; i < pairs.size(); ++i) count += clusters.applies(*pairs[i].m_pProxy0, *pairs[i].m_pProxy1);
  return count;
}

std::size_t touchingPairsOfClusters(const StockWorld& world, const std::vector<TouchPoint>& sorted) {
  const auto proxy = [&](int body) { return world.objects[std::size_t(body)]->getBroadphaseHandle(); };
  detail::ClusterTest clusters(ClusteredOctreeBroadphase::kDefaultDepth);
  std::size_t count = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const auto [a, b] = sorted[i].bodies;
    if (i > 0 && sorted[i - 1].bodies == sorted[i].bodies) continue;
    count += clusters.applies(*proxy(a), *proxy(b));
  }
  return count;
}

std::string firstDifference(const std::vector<TouchPoint>& found, const std::vector<TouchPoint>& expected) {
  const auto [other, lost] = std::ranges::mismatch(found, expected);
  const auto [a, b] = lost == expected.end() ? other->bodies : lost->bodies;
  std::ostringstream text;
  text << "of " << a << " and " << b << "; " << found.size() << " points for " << expected.size();
  return text.str();
}

const auto kNameOfLife = [](const ::testing::TestParamInfo<Life>& info) {
  return std::string(info.param.name);
};

class BroadphaseContacts : public ::testing::TestWithParam<Life> {};
// Nearly at rest, slow, and fast enough to leave Bullet's enlarged boxes. The last world mixes them, with
// many bodies and many steps.
INSTANTIATE_TEST_SUITE_P(lives, BroadphaseContacts,
                         ::testing::Values(Life{"still", 140, 24, 12, 9, 0.002, 0.002},
                                           Life{"slow", 140, 24, 12, 9, 0.05, 0.05},
                                           Life{"fast", 140, 24, 12, 9, 1.0, 1.0},
                                           Life{"long", 560, 2000, 4, 18, 0.001, 1.0}),
                         kNameOfLife);

TEST_P(BroadphaseContacts, areAllThere) {
  Twins twins(GetParam());
  StockWorld& stock = twins.stock();
  TightWorld& tight = twins.tight();
  std::size_t bodies = 0, points = 0, ghost_overlaps = 0;
  std::size_t stock_pairs = 0, tight_pairs = 0, touching_pairs = 0;  // pairs that clusters decide
  for (int step = 0; step < GetParam().steps; ++step) {
    twins.step();
    const std::vector<TouchPoint> expected = touchPoints(stock), found = touchPoints(tight);
    ASSERT_TRUE(found == expected) << "step " << step << ": " << firstDifference(found, expected);
    ASSERT_NO_FATAL_FAILURE(testing::expectPairsOf(stock, tight)) << "step " << step;
    ASSERT_TRUE(twins.ghostsAgree(ghost_overlaps)) << "step " << step;
    bodies += std::size_t(stock.world.getNumCollisionObjects());
    points += expected.size();
    stock_pairs += pairsOfClusters(stock);
    tight_pairs += pairsOfClusters(tight);
    touching_pairs += touchingPairsOfClusters(stock, expected);
  }
  const double steps = GetParam().steps, least_bodies = 0.9 * GetParam().bodies;
  const double touching = double(touching_pairs), kept = double(tight_pairs), all = double(stock_pairs);
  EXPECT_GT(double(bodies) / steps, least_bodies);
  EXPECT_GT(double(points), touching);
  EXPECT_GT(ghost_overlaps, 0u);
  EXPECT_GT(touching, 0.2 * kept);
  EXPECT_LT(touching, 0.9 * kept);
  EXPECT_GT(touching, 0.08 * all);
  EXPECT_LT(kept, 0.9 * all);
  RecordProperty("bodies", std::to_string(double(bodies) / steps));
  RecordProperty("points", std::to_string(double(points) / steps));
  RecordProperty("stock_pairs", std::to_string(all / steps));
  RecordProperty("tight_pairs", std::to_string(kept / steps));
  RecordProperty("touching_pairs", std::to_string(touching / steps));
}

/// A body of two pieces. Only one of them is in the tube of a solid ring, far from its surface.
TEST(BroadphaseContacts, aPieceInsideASolidIsFound) {
  const auto piece = testing::boxMesh({0.2, 0.2, 0.2});
  const auto pieces =
      testing::shapeOf(testing::joined(*testing::moved(*piece, {Mat3::Identity(), Vec3(1.2, 0, 0)}),
                                       *testing::moved(*piece, {Mat3::Identity(), Vec3(-1.2, 0, 0)})));
  const auto ring = testing::shapeOf(testing::torus(4, 1, 64, 32));
  for (const double x : {5.2, 2.8}) {  // the second piece, the first piece
    StockWorld stock;
    TightWorld tight;
    const auto pointsOf = [&](auto& world) {
      world.add(*pieces, testing::at(x, 0, 0));
      world.add(*ring, testing::at(0, 0, 0));
      world.world.performDiscreteCollisionDetection();
      return touchPoints(world);
    };
    const auto expected = pointsOf(stock);
    ASSERT_FALSE(expected.empty());
    const auto depth = [](const TouchPoint& point) { return -point.place.back(); };
    EXPECT_GT(depth(*std::ranges::max_element(expected, {}, depth)), 1.0);
    EXPECT_EQ(pointsOf(tight), expected) << x;
  }
}

}  // namespace
}  // namespace octoblisk
