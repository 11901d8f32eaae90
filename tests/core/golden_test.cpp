// The bits of trees and answers, committed as hashes: any compiler, build type, instruction set and number of
// threads gives these. A change that means to change them writes the new ones here, which the failing test
// tells, and says so.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/golden_scene.h"
#include "core/only_targets.h"
#include "octoblisk/batch.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/clusters_near.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "octoblisk/containment.h"
#include "octoblisk/depth.h"
#include "octoblisk/distance.h"
#include "octoblisk/half_space_contacts.h"
#include "octoblisk/k_means.h"
#include "octoblisk/mass_properties.h"
#include "octoblisk/raycast.h"
#include "octoblisk/source_contacts.h"
#include "octoblisk/sweep.h"
#include "octoblisk/tree_blob.h"
#include "shared/mesh_source.h"

namespace octoblisk {
namespace {

using testing::Answers;
using testing::OnlyTargets;
using testing::SharedMesh;

struct Golden {
  const char* of;
  std::uint64_t hash;
  bool operator==(const Golden&) const = default;
};

const std::vector<Golden> kGolden = {
    {"trees", 0x9aa0f0f487e9cc0au},
    {"fast trees", 0xe52eb7b2bd94ae4du},
    {"compact trees", 0x066a4ecc81eeb0cau},
    {"the paper's trees", 0x0f1cbe4e374e4ad8u},
    {"refit", 0x92976be164151401u},
    {"collide", 0xb26d2f877a3cbb3bu},
    {"collide with a soup", 0x60f3a3c57a5449bbu},
    {"touching pairs", 0xe1041353fecff6c5u},
    {"touching pairs with a soup", 0x5bd1d512cd2585d6u},
    {"contacts", 0xb36e19ff854bcb3fu},
    {"contacts with a soup", 0x78eddf4b86c8b69bu},
    {"contacts of a source", 0x6e82fb0fffdae8a9u},
    {"clusters near", 0x24d4d8a04287b03au},
    {"contacts of convex bodies", 0x58664b8f0bb4cd9au},
    {"distance", 0x59aa96b2d8416f72u},
    {"rays", 0x1547be03d967fea6u},
    {"motions", 0xb57082999be5c340u},
    {"sweeps", 0x78529b7a550b8faeu},
    {"solids", 0x7f60464654bb3ca2u},
};

/// Two balls and a soup, which the balls meet in about half of the poses.
struct Scene {
  SharedMesh ball, knob, soup;
  std::vector<Pose> poses;

  Scene() {
    std::mt19937_64 random(2026);
    ball = testing::bumpyBall(random, 1.0, 0.1, 24);
    knob = testing::bumpyBall(random, 0.4, 0.02, 8);
    soup = testing::soup(random, 3000, 1.5, 0.1);
    for (int i = 0; i < 60; ++i) poses.push_back(testing::poseAt(random, testing::uniform(random, 0.9, 1.9)));
  }
};

void add(Answers& answers, const Contact& contact) {
  for (const Vec3* point : {&contact.point_on_a, &contact.point_on_b, &contact.normal}) answers.add(*point);
  answers.add(contact.distance);
  answers.add(std::uint64_t{contact.triangle_a} << 32 | contact.triangle_b);
}

void add(Answers& answers, const Clearance& clearance) {
  answers.add(clearance.point_on_a);
  answers.add(clearance.point_on_b);
  answers.add(clearance.distance);
  answers.add(std::uint64_t{clearance.triangle_a} << 32 | clearance.triangle_b);
}

std::uint64_t hashOfTrees(const Scene& scene, BuildOptions options, int threads) {
  options.threads = threads;
  Answers answers;
  for (const SharedMesh& mesh : {scene.ball, scene.knob, scene.soup})
    answers.add(toBlob(ClusteredOctree::build(mesh, options)));
  return answers.hash();
}

std::uint64_t hashOfRefit(const Scene& scene, const ClusteredOctree& ball, int threads) {
  std::vector<Vec3> vertices = scene.ball->vertices();
  for (Vec3& vertex : vertices)
    vertex = {1.25 * vertex.x(), vertex.y() + 0.25 * vertex.x(), 0.5 * vertex.z()};
  Answers answers;
  answers.add(toBlob(
      ball.refitted(std::make_shared<const TriangleMesh>(vertices, scene.ball->triangles()), threads)));
  return answers.hash();
}

/// How many of the poses are hits is told too: hashes of misses alone would say little.
std::uint64_t hashOfCollide(const Scene& scene, const ClusteredOctree& a, const ClusteredOctree& b,
                            int threads, std::size_t& hits) {
  Answers answers;
  hits = 0;
  for (const auto& pair : collideAll(a, b, scene.poses, threads)) {
    hits += pair.has_value();
    answers.add(pair ? std::uint64_t{pair->a} << 32 | pair->b : ~std::uint64_t{0});
  }
  return answers.hash();
}

std::uint64_t hashOfTouchingPairs(const Scene& scene, const ClusteredOctree& a, const ClusteredOctree& b) {
  Answers answers;
  std::vector<TrianglePair> pairs;
  for (const Pose& pose : scene.poses) {
    touchingPairs(a, b, pose, pairs);
    answers.add(std::uint64_t{pairs.size()});
    for (const TrianglePair& pair : pairs) answers.add(std::uint64_t{pair.a} << 32 | pair.b);
  }
  return answers.hash();
}

std::uint64_t hashOfContacts(const Scene& scene, const ClusteredOctree& a, const ClusteredOctree& b) {
  Answers answers;
  std::vector<Contact> found;
  for (const Pose& pose : scene.poses) {
    contacts(a, b, pose, 0.05, found);
    for (const Contact& contact : found) add(answers, contact);
  }
  return answers.hash();
}

std::uint64_t hashOfSourceContacts(const Scene& scene, const ClusteredOctree& a, const TriangleMesh& b) {
  Answers answers;
  const testing::MeshSource source(b);
  SourceContacts query;
  std::vector<Contact> found;
  for (const Pose& pose : scene.poses) {
    query.find(a, source, pose, 0.05, found);
    for (const Contact& contact : found) {
      add(answers, contact);
      answers.add(static_cast<std::uint64_t>(query.triangle(contact.triangle_b).index));
    }
  }
  return answers.hash();
}

/// Of all depths, and which share of the answers is yes.
std::uint64_t hashOfClustersNear(const Scene& scene, const ClusteredOctree& a, const ClusteredOctree& b,
                                 double& near) {
  Answers answers;
  int yes = 0, asked = 0;
  for (const Pose& pose : scene.poses) {
    for (int depth = 0; depth <= 5; ++depth) {
      const Obb box{pose.translation, pose.rotation, Vec3(0.4, 0.1, 0.05)};
      for (const bool answer : {clustersNear(a, b, pose, 0.02, depth), clustersNear(a, box, 0.02, depth)}) {
        answers.add(std::uint64_t{answer});
        yes += answer;
        ++asked;
      }
    }
  }
  near = static_cast<double>(yes) / asked;
  return answers.hash();
}

std::uint64_t hashOfConvexContacts(const Scene& scene, const ClusteredOctree& a) {
  Answers answers;
  std::vector<Contact> found;
  const ConvexHull capsule({{0, 0, -0.4}, {0, 0, 0.4}}, 0.15);
  const ConvexBox box({.half_extents = {0.5, 0.3, 0.2}});
  for (const Pose& pose : scene.poses) {
    for (const Convex* convex : {static_cast<const Convex*>(&capsule), static_cast<const Convex*>(&box)}) {
      contacts(a, *convex, pose, 0.05, found);
      for (const Contact& contact : found) add(answers, contact);
      add(answers, distance(a, *convex, pose));
    }
    contacts(a, HalfSpace{pose.rotation.col(2), -0.9}, 0.05, found);
    for (const Contact& contact : found) add(answers, contact);
  }
  return answers.hash();
}

std::uint64_t hashOfDistance(const Scene& scene, const ClusteredOctree& a, const ClusteredOctree& b,
                             int threads) {
  Answers answers;
  for (const Clearance& clearance : distanceAll(a, b, scene.poses, {}, threads)) add(answers, clearance);
  for (const Pose& pose : scene.poses) {
    if (const auto closest = closestPoint(a, pose.translation)) answers.add(closest->point);
  }
  return answers.hash();
}

std::uint64_t hashOfRays(const Scene& scene, const ClusteredOctree& a) {
  Answers answers;
  std::vector<RayHit> hits;
  for (const Pose& pose : scene.poses) {
    allHits(a, {.origin = 3.0 * pose.translation, .direction = pose.rotation.col(0) - pose.translation},
            hits);
    for (const RayHit& hit : hits) {
      answers.add(hit.t);
      answers.add(std::uint64_t{hit.triangle});
      answers.add(hit.normal);
    }
  }
  return answers.hash();
}

std::uint64_t hashOfMotions(const Scene& scene, const ClusteredOctree& a, const ClusteredOctree& b) {
  Answers answers;
  for (std::size_t i = 0; i + 1 < scene.poses.size(); i += 2) {
    const Motion motion(scene.poses[i], scene.poses[i + 1]);
    answers.add(
        relativeLengthBound(a, Motion::about({}, Vec3::Zero(), scene.poses[i].translation), b, motion));
    for (int step = 0; step <= 100; ++step) {
      const Pose pose = motion.at(0.01 * step);
      answers.add(pose.translation);
      for (int k = 0; k < 3; ++k) answers.add(Vec3(pose.rotation.col(k)));
    }
  }
  return answers.hash();
}

std::uint64_t hashOfSweeps(const Scene& scene, const ClusteredOctree& a, const ClusteredOctree& b) {
  Answers answers;
  for (std::size_t i = 0; i + 1 < scene.poses.size(); i += 2) {
    Pose from = scene.poses[i], to = scene.poses[i + 1];
    from.translation *= 2.0;
    const auto impact = sweep(a, b, Motion(from, to), 0.01);
    answers.add(impact ? impact->fraction : 2.0);
    if (impact) add(answers, impact->clearance);
  }
  return answers.hash();
}

std::uint64_t hashOfSolids(const Scene& scene, const ClusteredOctree& a, const ClusteredOctree& b) {
  Answers answers;
  const Surface solid_a(a), solid_b(b);
  DepthQuery query;
  for (const Pose& pose : scene.poses) {
    answers.add(static_cast<std::uint64_t>(containment(solid_a, solid_b, pose)));
    const GougeDepth depth = query.deepest(solid_a, solid_b, pose, 0.01);
    answers.add(depth.depth);
    answers.add(depth.upper_bound);
    answers.add(depth.point_on_a);
  }
  const MassProperties mass = massProperties(a.mesh());
  const PrincipalFrame frame = principalFrame(mass);
  answers.add(mass.volume);
  answers.add(mass.center_of_mass);
  answers.add(frame.moments);
  for (int k = 0; k < 3; ++k) answers.add(Vec3(frame.in_mesh.rotation.col(k)));
  const Clustering clusters = kMeans(scene.soup->vertices(), {.k = 5});
  for (const Vec3& center : clusters.centers) answers.add(center);
  answers.add(clusters.squared_error);
  return answers.hash();
}

std::vector<Golden> goldenOf(const Scene& scene, int threads, std::size_t& hits) {
  const BuildOptions fast{.quality = BuildQuality::fast}, compact{.storage = Storage::compact},
      paper{.partition = PartitionKind::paper, .leaf_capacity = 4, .clusters = 3};
  const ClusteredOctree ball = ClusteredOctree::build(scene.ball), knob = ClusteredOctree::build(scene.knob),
                        soup = ClusteredOctree::build(scene.soup);
  std::size_t hits_of_knob, hits_of_soup;
  double near = 0.0;
  std::vector<Golden> found = {
      {"trees", hashOfTrees(scene, {}, threads)},
      {"fast trees", hashOfTrees(scene, fast, threads)},
      {"compact trees", hashOfTrees(scene, compact, threads)},
      {"the paper's trees", hashOfTrees(scene, paper, threads)},
      {"refit", hashOfRefit(scene, ball, threads)},
      {"collide", hashOfCollide(scene, ball, knob, threads, hits_of_knob)},
      {"collide with a soup", hashOfCollide(scene, soup, knob, threads, hits_of_soup)},
      {"touching pairs", hashOfTouchingPairs(scene, ball, knob)},
      {"touching pairs with a soup", hashOfTouchingPairs(scene, soup, knob)},
      {"contacts", hashOfContacts(scene, ball, knob)},
      {"contacts with a soup", hashOfContacts(scene, soup, knob)},
      {"contacts of a source", hashOfSourceContacts(scene, soup, *scene.knob)},
      {"clusters near", hashOfClustersNear(scene, ball, knob, near)},
      {"contacts of convex bodies", hashOfConvexContacts(scene, ball)},
      {"distance", hashOfDistance(scene, ball, knob, threads)},
      {"rays", hashOfRays(scene, soup)},
      {"motions", hashOfMotions(scene, ball, knob)},
      {"sweeps", hashOfSweeps(scene, ball, knob)},
      {"solids", hashOfSolids(scene, ball, knob)},
  };
  EXPECT_GT(near, 0.3);
  EXPECT_LT(near, 0.9);
  hits = hits_of_knob;
  return found;
}

std::string written(const std::vector<Golden>& golden) {
  std::string text;
  char line[80];
  for (const Golden& one : golden) {
    std::snprintf(line, sizeof line, "    {\"%s\", 0x%016llxu},\n", one.of,
                  static_cast<unsigned long long>(one.hash));
    text += line;
  }
  return text;
}

/// Eigen fuses products and sums where the compiler is told that the processor can: other last bits.
#ifdef __FMA__
constexpr bool kFused = true;
#else
constexpr bool kFused = false;
#endif

void expectGolden(const std::vector<Golden>& found) { EXPECT_EQ(written(found), written(kGolden)); }

TEST(Golden, isTheSameForAnyNumberOfThreads) {
  if (kFused) GTEST_SKIP() << "compiled with -mfma";
  const Scene scene;
  for (const int threads : {1, 5}) {
    std::size_t hits = 0;
    expectGolden(goldenOf(scene, threads, hits));
    EXPECT_GT(hits, scene.poses.size() * 3 / 10);
    EXPECT_LT(hits, scene.poses.size() * 7 / 10);
  }
}

TEST(Golden, isTheSameOnEveryInstructionSet) {
  if (kFused) GTEST_SKIP() << "compiled with -mfma";
  const Scene scene;
  std::vector<std::int64_t> targets = testing::compiledTargets();
  targets.erase(targets.begin());  // the best is used where nothing else is asked for
  for (const std::int64_t target : targets) {
    const OnlyTargets only(target);
    std::size_t hits = 0;
    SCOPED_TRACE(::testing::Message() << std::hex << target);
    expectGolden(goldenOf(scene, 0, hits));
  }
}

}  // namespace
}  // namespace octoblisk
