#include "core/golden_answers.h"

#include "build/paper/k_means.h"
#include "core/golden_scene.h"
#include "octoblisk/batch.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "octoblisk/containment.h"
#include "octoblisk/depth.h"
#include "octoblisk/distance.h"
#include "octoblisk/half_space_contacts.h"
#include "octoblisk/mass_properties.h"
#include "octoblisk/raycast.h"
#include "octoblisk/source_contacts.h"
#include "octoblisk/sweep.h"
#include "octoblisk/tree_blob.h"
#include "query/clusters_near.h"
#include "shared/mesh_source.h"
#include "shared/solids.h"

namespace octoblisk::testing {

using namespace detail;

namespace {

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

std::uint64_t hashOfTrees(const GoldenScene& scene, BuildOptions options, int threads) {
  options.threads = threads;
  Answers answers;
  for (const SharedMesh& mesh : {scene.ball, scene.knob, scene.soup})
    answers.add(toBlob(ClusteredOctree::build(mesh, options)));
  return answers.hash();
}

std::uint64_t hashOfRefit(const GoldenScene& scene, const ClusteredOctree& ball, int threads) {
  std::vector<Vec3> vertices = scene.ball->vertices();
  for (Vec3& vertex : vertices)
    vertex = {1.25 * vertex.x(), vertex.y() + 0.25 * vertex.x(), 0.5 * vertex.z()};
  Answers answers;
  answers.add(toBlob(
      ball.refitted(std::make_shared<const TriangleMesh>(vertices, scene.ball->triangles()), threads)));
  return answers.hash();
}

std::uint64_t hashOfCollide(const GoldenScene& scene, const ClusteredOctree& a, const ClusteredOctree& b,
                            int threads, std::size_t& hits) {
  Answers answers;
  hits = 0;
  for (const auto& pair : collideAll(a, b, scene.poses, threads)) {
    hits += pair.has_value();
    answers.add(pair ? std::uint64_t{pair->a} << 32 | pair->b : ~std::uint64_t{0});
  }
  return answers.hash();
}

std::uint64_t hashOfTouchingPairs(const GoldenScene& scene, const ClusteredOctree& a,
                                  const ClusteredOctree& b) {
  Answers answers;
  std::vector<TrianglePair> pairs;
  for (const Pose& pose : scene.poses) {
    touchingPairs(a, b, pose, pairs);
    answers.add(std::uint64_t{pairs.size()});
    for (const TrianglePair& pair : pairs) answers.add(std::uint64_t{pair.a} << 32 | pair.b);
  }
  return answers.hash();
}

std::uint64_t hashOfContacts(const GoldenScene& scene, const ClusteredOctree& a, const ClusteredOctree& b) {
  Answers answers;
  std::vector<Contact> found;
  for (const Pose& pose : scene.poses) {
    contacts(a, b, pose, 0.05, found);
    for (const Contact& contact : found) add(answers, contact);
  }
  return answers.hash();
}

std::uint64_t hashOfSourceContacts(const GoldenScene& scene, const ClusteredOctree& a,
                                   const TriangleMesh& b) {
  Answers answers;
  const MeshSource source(b);
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

/// Hashes the answers for all depths, and computes the share of positive answers.
std::uint64_t hashOfClustersNear(const GoldenScene& scene, const ClusteredOctree& a, const ClusteredOctree& b,
                                 double& share_near) {
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
  share_near = static_cast<double>(yes) / asked;
  return answers.hash();
}

std::uint64_t hashOfConvexContacts(const GoldenScene& scene, const ClusteredOctree& a) {
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

std::uint64_t hashOfDistance(const GoldenScene& scene, const ClusteredOctree& a, const ClusteredOctree& b,
                             int threads) {
  Answers answers;
  for (const Clearance& clearance : distanceAll(a, b, scene.poses, {}, threads)) add(answers, clearance);
  for (const Pose& pose : scene.poses) {
    if (const auto closest = closestPoint(a, pose.translation)) answers.add(closest->point);
  }
  return answers.hash();
}

std::uint64_t hashOfRays(const GoldenScene& scene, const ClusteredOctree& a) {
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

std::uint64_t hashOfMotions(const GoldenScene& scene, const ClusteredOctree& a, const ClusteredOctree& b) {
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

std::uint64_t hashOfSweeps(const GoldenScene& scene, const ClusteredOctree& a, const ClusteredOctree& b) {
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

std::uint64_t hashOfConvexSweeps(const GoldenScene& scene, const ClusteredOctree& a) {
  Answers answers;
  const ConvexHull capsule({{0, 0, -0.4}, {0, 0, 0.4}}, 0.15);
  const ConvexBox box({.half_extents = {0.5, 0.3, 0.2}});
  for (std::size_t i = 0; i + 1 < scene.poses.size(); i += 2) {
    Pose from = scene.poses[i], to = scene.poses[i + 1];
    from.translation *= 2.0;
    for (const Convex* convex : {static_cast<const Convex*>(&capsule), static_cast<const Convex*>(&box)}) {
      const auto impact = sweep(a, *convex, Motion(from, to), 0.01);
      answers.add(impact ? impact->fraction : 2.0);
      if (impact) add(answers, impact->clearance);
    }
  }
  return answers.hash();
}

std::uint64_t hashOfSolids(const GoldenScene& scene, const ClusteredOctree& a, const ClusteredOctree& b) {
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
  const Clustering clusters = kMeans(scene.soup->vertices(), {.k = 5, .starts = 1});
  for (const Vec3& center : clusters.centers) answers.add(center);
  answers.add(clusters.squared_error);
  return answers.hash();
}

/// Two knobs that overlap, and one that lacks a facet. One of the first two has a crack and doubled facets.
std::uint64_t hashOfDefects(const GoldenScene& scene, const ClusteredOctree& b, int threads) {
  Answers answers;
  const SharedMesh& knob = scene.knob;
  std::vector<TriangleMesh::Indices> triangles = knob->triangles();
  const SharedMesh without_first = std::make_shared<const TriangleMesh>(
      knob->vertices(), std::vector<TriangleMesh::Indices>(triangles.begin() + 1, triangles.end()));
  for (std::size_t t = 0; t < knob->triangleCount(); t += 5) triangles.push_back(triangles[t]);
  std::vector<Vec3> vertices = knob->vertices();
  for (std::size_t t = 7; t < knob->triangleCount(); t += 50) {
    vertices.push_back(vertices[triangles[t][0]] + Vec3::Constant(0x1p-20));
    triangles[t][0] = static_cast<std::uint32_t>(vertices.size() - 1);
  }
  const TriangleMesh cracked(std::move(vertices), std::move(triangles));
  const SharedMesh overlapping =
      joined(cracked, *moved(*knob, {Mat3::Identity(), Vec3(0.25, 0.125, 0.0625)}));
  DepthQuery query;
  for (const SharedMesh& mesh : {overlapping, without_first}) {
    const ClusteredOctree tree = ClusteredOctree::build(mesh, {.threads = threads});
    const Surface surface(tree, threads), solid_b(b);
    answers.add(std::uint64_t{surface.isClosed()} << 1 | std::uint64_t{surface.isWhole()});
    for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t)
      answers.add(static_cast<std::uint64_t>(surface.role(t)));
    for (const Vec3& vertex : surface.boundary().mesh().vertices()) answers.add(vertex);
    const MassProperties mass = massProperties(surface);
    answers.add(mass.volume);
    answers.add(mass.center_of_mass);
    for (const Pose& pose : scene.poses) {
      const Pose near{pose.rotation, 0.375 * pose.translation};
      answers.add(static_cast<std::uint64_t>(locate(surface, near.translation, near)));
      answers.add(static_cast<std::uint64_t>(locate(surface, near.translation)));
      answers.add(static_cast<std::uint64_t>(containment(surface, solid_b, near)));
      const GougeDepth depth = query.deepest(surface, solid_b, near, 0.01);
      answers.add(depth.depth);
      answers.add(depth.upper_bound);
      answers.add(depth.point_on_a);
    }
  }
  return answers.hash();
}

}  // namespace

GoldenScene::GoldenScene() {
  std::mt19937_64 random(2026);
  ball = bumpyBall(random, 1.0, 0.1, 24);
  knob = bumpyBall(random, 0.4, 0.02, 8);
  soup = testing::soup(random, 3000, 1.5, 0.1);
  for (int i = 0; i < 60; ++i) poses.push_back(poseAt(random, uniform(random, 0.9, 1.9)));
}

GoldenAnswers goldenAnswers(const GoldenScene& scene, int threads) {
  const BuildOptions fast{.quality = BuildQuality::low}, compact{.storage = Storage::compact},
      paper{.partition = PartitionKind::paper, .leaf_capacity = 4, .clusters = 3};
  const ClusteredOctree ball = ClusteredOctree::build(scene.ball), knob = ClusteredOctree::build(scene.knob),
                        soup = ClusteredOctree::build(scene.soup);
  GoldenAnswers found;
  std::size_t hits_of_soup;
  found.hashes = {
      {"trees", hashOfTrees(scene, {}, threads)},
      {"fast trees", hashOfTrees(scene, fast, threads)},
      {"compact trees", hashOfTrees(scene, compact, threads)},
      {"the paper's trees", hashOfTrees(scene, paper, threads)},
      {"refit", hashOfRefit(scene, ball, threads)},
      {"collide", hashOfCollide(scene, ball, knob, threads, found.hits)},
      {"collide with a soup", hashOfCollide(scene, soup, knob, threads, hits_of_soup)},
      {"touching pairs", hashOfTouchingPairs(scene, ball, knob)},
      {"touching pairs with a soup", hashOfTouchingPairs(scene, soup, knob)},
      {"contacts", hashOfContacts(scene, ball, knob)},
      {"contacts with a soup", hashOfContacts(scene, soup, knob)},
      {"contacts of a source", hashOfSourceContacts(scene, soup, *scene.knob)},
      {"clusters near", hashOfClustersNear(scene, ball, knob, found.share_near)},
      {"contacts of convex bodies", hashOfConvexContacts(scene, ball)},
      {"distance", hashOfDistance(scene, ball, knob, threads)},
      {"rays", hashOfRays(scene, soup)},
      {"motions", hashOfMotions(scene, ball, knob)},
      {"sweeps", hashOfSweeps(scene, ball, knob)},
      {"sweeps of convex bodies", hashOfConvexSweeps(scene, ball)},
      {"solids", hashOfSolids(scene, ball, knob)},
      {"solids with defects", hashOfDefects(scene, knob, threads)},
  };
  return found;
}

}  // namespace octoblisk::testing
