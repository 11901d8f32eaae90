// Compares whole-mesh queries with exact arithmetic and FCL, at random poses and at poses that barely touch.
#include <fcl/narrowphase/collision.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <optional>

#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "shared/brute_force.h"
#include "shared/cgal_shapes.h"
#include "shared/fcl_model.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::SharedMesh;
using Pairs = std::vector<TrianglePair>;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kScale = 10;  // fewer poses under a sanitizer
#else
constexpr int kScale = 1;
#endif

struct Scene {
  const char* name;
  SharedMesh a, b;
  double spread;  ///< of the translations
  int poses;
};

std::vector<Scene> scenes() {
  std::mt19937_64 random(31);
  return {{"linked tori", testing::torus(3, 1, 32, 16), testing::torus(3, 0.8, 32, 16), 5.5, 200},
          {"torus in a fan", testing::fan(9, 10), testing::torus(0.5, 0.15, 20, 12), 1.3, 300},
          {"soups", testing::soup(random, 300, 5, 0.4), testing::soup(random, 300, 5, 0.4), 8.0, 200},
          {"sheets", testing::waveSheet(4, 0.5, 24), testing::waveSheet(3, 0.5, 24), 4.5, 200},
          {"boxes", testing::boxMesh({1, 2, 3}), testing::boxMesh({2, 1, 1}), 4.4, 500}};
}

/// The same two meshes in the library and in FCL.
class Bodies {
 public:
  explicit Bodies(const Scene& scene)
      : mesh_a_(scene.a),
        mesh_b_(scene.b),
        tree_a_(ClusteredOctree::build(scene.a)),
        tree_b_(ClusteredOctree::build(scene.b)),
        fcl_a_(testing::FclMesh(*scene.a).model()),
        fcl_b_(testing::FclMesh(*scene.b).model()) {}

  bool exactlyMeet(const Pose& b_in_a, TrianglePair pair) const {
    return testing::exactlyMeet(mesh_a_->triangle(pair.a), b_in_a * mesh_b_->triangle(pair.b));
  }
  Pairs bruteForce(const Pose& b_in_a) const { return testing::bruteForcePairs(*mesh_a_, *mesh_b_, b_in_a); }
  std::optional<TrianglePair> collision(const Pose& b_in_a) const {
    return collide(tree_a_, tree_b_, b_in_a);
  }

  Pairs touching(const Pose& b_in_a) const {
    std::vector<Contact> found;
    contacts(tree_a_, tree_b_, b_in_a, 0.0, found);
    Pairs pairs;
    for (const Contact& contact : found) pairs.push_back({contact.triangle_a, contact.triangle_b});
    return pairs;
  }

  Pairs byFcl(const Pose& b_in_a) const {
    fcl::CollisionResultd result;
    fcl::collide<double>(fcl_a_.get(), fcl::Transform3d::Identity(), fcl_b_.get(),
                         testing::fclTransform(b_in_a), fcl::CollisionRequestd(1'000'000), result);
    Pairs pairs;
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
      const auto& contact = result.getContact(i);
      pairs.push_back({static_cast<std::uint32_t>(contact.b1), static_cast<std::uint32_t>(contact.b2)});
    }
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

 private:
  SharedMesh mesh_a_, mesh_b_;
  ClusteredOctree tree_a_, tree_b_;
  std::unique_ptr<testing::FclModel> fcl_a_, fcl_b_;
};

struct Tally {
  int poses = 0, hits = 0;
  int fcl_missed = 0, fcl_made_up = 0;  ///< poses that FCL judges differently
  int pairs = 0, fcl_pairs_missed = 0, fcl_pairs_made_up = 0;
};

Pairs missingFrom(const Pairs& pairs, const Pairs& whole) {
  Pairs missing;
  std::ranges::set_difference(whole, pairs, std::back_inserter(missing));
  return missing;
}

/// Compares all answers at one pose. If FCL differs from the library, CGAL decides.
void compare(const Bodies& bodies, const Pose& pose, Tally& tally) {
  const Pairs expected = bodies.bruteForce(pose);
  const auto found = bodies.collision(pose);
  ASSERT_EQ(found.has_value(), !expected.empty());
  ASSERT_TRUE(!found || bodies.exactlyMeet(pose, *found));
  ASSERT_EQ(bodies.touching(pose), expected);

  const Pairs by_fcl = bodies.byFcl(pose);
  const Pairs missed = missingFrom(by_fcl, expected), made_up = missingFrom(expected, by_fcl);
  for (const TrianglePair& pair : missed) ASSERT_TRUE(bodies.exactlyMeet(pose, pair)) << "FCL is right";
  for (const TrianglePair& pair : made_up) ASSERT_FALSE(bodies.exactlyMeet(pose, pair)) << "FCL is right";
  ++tally.poses;
  tally.hits += !expected.empty();
  tally.fcl_missed += by_fcl.empty() && !expected.empty();
  tally.fcl_made_up += !by_fcl.empty() && expected.empty();
  tally.pairs += static_cast<int>(expected.size());
  tally.fcl_pairs_missed += static_cast<int>(missed.size());
  tally.fcl_pairs_made_up += static_cast<int>(made_up.size());
}

void report(const char* name, const Tally& tally) {
  std::cout << name << ": " << tally.hits << " of " << tally.poses << " poses hit, " << tally.pairs
            << " pairs; FCL judges " << tally.fcl_missed << " hits and " << tally.fcl_made_up
            << " misses wrongly, lacks " << tally.fcl_pairs_missed << " pairs, adds "
            << tally.fcl_pairs_made_up << '\n';
  EXPECT_GE(tally.hits, tally.poses * 3 / 10) << name;
  EXPECT_LE(tally.hits, tally.poses * 7 / 10) << name;
}

TEST(QueriesFcl, randomPoses) {
  for (const Scene& scene : scenes()) {
    const Bodies bodies(scene);
    std::mt19937_64 random(32);
    Tally tally;
    for (int i = 0; i < scene.poses / kScale; ++i) {
      SCOPED_TRACE(std::string(scene.name) + ", pose " + std::to_string(i));
      ASSERT_NO_FATAL_FAILURE(compare(bodies, testing::randomPose(random, scene.spread), tally));
    }
    report(scene.name, tally);
  }
}

/// Moves B along a direction from a pose at which the bodies meet to the last pose at which they do. Empty if
/// they never part.
std::optional<double> lastTouch(const Bodies& bodies, const Pose& pose, const Vec3& direction, double far) {
  const auto meets = [&](double way) {
    return bodies.collision({pose.rotation, pose.translation + way * direction}).has_value();
  };
  double touching = 0.0, apart = far;
  if (!meets(touching) || meets(apart)) return std::nullopt;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (touching + apart);
    (meets(middle) ? touching : apart) = middle;
  }
  return touching;
}

TEST(QueriesFcl, nearlyTouchingPoses) {
  for (const Scene& scene : scenes()) {
    const Bodies bodies(scene);
    std::mt19937_64 random(33);
    Tally tally;
    const int wanted = scene.poses / kScale;
    for (int i = 0; tally.poses < wanted; ++i) {
      ASSERT_LT(i, 20 * wanted);
      SCOPED_TRACE(std::string(scene.name) + ", pose " + std::to_string(i));
      Pose pose = testing::randomPose(random, scene.spread);
      if (i % 4 == 0) pose.rotation.setIdentity();  // aligned edges and faces
      const Vec3 direction =
          i % 8 == 0 ? Vec3(Vec3::Unit(i / 8 % 3)) : testing::randomPoint(random, 1).normalized();
      const std::optional<double> touch = lastTouch(bodies, pose, direction, 20.0);
      if (!touch) continue;
      const double clearance = std::pow(10.0, testing::uniform(random, -9, -3));
      for (const double way : {*touch, *touch + clearance, *touch - clearance, std::nextafter(*touch, 1e3)}) {
        const Pose nearly{pose.rotation, pose.translation + way * direction};
        ASSERT_NO_FATAL_FAILURE(compare(bodies, nearly, tally)) << "clearance " << way - *touch;
      }
    }
    report(scene.name, tally);
  }
}

}  // namespace
}  // namespace octoblisk
