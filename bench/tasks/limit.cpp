// Compares each query with a lower bound: the exact test of the triangles that really touch, without a search
// for them. The bound leaves out the proof that a clear pose or a free segment is clear.
#include <algorithm>

#include "boolean.h"
#include "contacts.h"
#include "distance.h"
#include "geometry/triangle_pair.h"
#include "octoblisk/collide.h"
#include "octoblisk/distance.h"
#include "octoblisk/raycast.h"
#include "ray.h"

namespace octoblisk::bench {

using namespace detail;

namespace {

constexpr const char* kBound = "lower-bound";
constexpr std::size_t kBundle = 20;  // poses between two clock readings; a reading takes as long as a test

const bool kRegistered = registerContender({.name = kBound, .group = "limit"});

/// OctoBlisk's trees, which find the relevant triangles before the timing.
struct Found {
  explicit Found(const Scene& scene)
      : blisk(ClusteredOctree::build(scene.blisk)), belt(ClusteredOctree::build(scene.belt)) {}
  ClusteredOctree blisk, belt;
};

const Found& foundIn(const Scene& scene) {
  static const Found found(scene);  // one scene per process
  return found;
}

/// The bytes of the corners of `triangles` triangles. A query must read each of them once.
double bytesOf(std::size_t triangles) { return static_cast<double>(triangles * sizeof(Triangle)); }

/// The task with the bound added to OctoBlisk. `bound` makes the bound's trial. Its answers are not compared,
/// because its triangles are the answers.
TimedTask withBound(TimedTask task, const std::function<Trial(const Scene&)>& bound) {
  task.group = "limit";
  task.can_do = [can_do = task.can_do](const Contender& c) { return c.name == kBound || can_do(c); };
  task.prepare = [prepare = task.prepare, bound](const Scene& scene, const Contender& contender) {
    return contender.name == kBound ? bound(scene) : prepare(scene, contender);
  };
  return task;
}

/// Tests the pairs of each pose. B's triangle is posed in the same way as in the query.
Trial pairsTrial(const Scene& scene, bool all) {
  auto pairs = std::make_shared<std::vector<std::vector<TrianglePair>>>();
  std::size_t count = 0, triangles = 0;
  const Found& found = foundIn(scene);
  for (const Pose& pose : scene.path) {
    std::vector<TrianglePair>& here = pairs->emplace_back();
    if (all) {
      touchingPairs(found.blisk, found.belt, pose, here);
    } else if (const auto pair = collide(found.blisk, found.belt, pose)) {
      here = {*pair};
    }
    count += here.size();
    std::vector<std::uint32_t> of_blisk, of_belt;
    for (const TrianglePair& pair : here) {
      of_blisk.push_back(pair.a);
      of_belt.push_back(pair.b);
    }
    for (std::vector<std::uint32_t>* list : {&of_blisk, &of_belt}) {
      std::ranges::sort(*list);
      triangles += static_cast<std::size_t>(std::unique(list->begin(), list->end()) - list->begin());
    }
  }
  const auto poses = static_cast<double>(scene.path.size());
  return {.questions = scene.path.size() / kBundle,
          .asked_at_once = kBundle,
          .ask =
              [pairs, &scene](std::size_t bundle) {
                for (std::size_t k = bundle * kBundle; k < (bundle + 1) * kBundle; ++k) {
                  for (const TrianglePair& pair : (*pairs)[k]) {
                    benchmark::DoNotOptimize(intersects(scene.blisk->triangle(pair.a),
                                                        scene.path[k] * scene.belt->triangle(pair.b)));
                  }
                }
              },
          .counters = {{"exact_tests", static_cast<double>(count) / poses},
                       {"bytes", bytesOf(triangles) / poses}}};
}

/// Measures the nearest pair of each clear pose.
Trial distanceTrial(const Scene& scene) {
  const Distances& distances = distancesOf(scene);
  auto nearest = std::make_shared<std::vector<Clearance>>();
  for (const Pose& pose : distances.poses)
    nearest->push_back(distance(foundIn(scene).blisk, foundIn(scene).belt, pose));
  return {.questions = distances.poses.size() / kBundle,
          .asked_at_once = kBundle,
          .ask =
              [nearest, &distances, &scene](std::size_t bundle) {
                for (std::size_t k = bundle * kBundle; k < (bundle + 1) * kBundle; ++k) {
                  const Clearance& pair = (*nearest)[k];
                  benchmark::DoNotOptimize(
                      closestPoints(scene.blisk->triangle(pair.triangle_a),
                                    distances.poses[k] * scene.belt->triangle(pair.triangle_b)));
                }
              },
          .counters = {{"exact_tests", 1.0}, {"bytes", bytesOf(2)}}};
}

/// Computes where each segment crosses the plane of the triangle that it hits.
Trial hitsTrial(const Scene& scene) {
  constexpr std::size_t kSegments = 100;  // per bundle
  auto hit = std::make_shared<std::vector<std::uint32_t>>();
  std::size_t hits = 0;
  for (const Segment& segment : scene.segments) {
    const auto found = closestHit(
        foundIn(scene).blisk, {.origin = segment.from, .direction = segment.to - segment.from, .t_max = 1.0});
    hit->push_back(found ? found->triangle : kNoTriangle);
    hits += found.has_value();
  }
  const double part = static_cast<double>(hits) / static_cast<double>(scene.segments.size());
  return {.questions = scene.segments.size() / kSegments,
          .asked_at_once = kSegments,
          .ask =
              [hit, &scene](std::size_t bundle) {
                for (std::size_t k = bundle * kSegments; k < (bundle + 1) * kSegments; ++k) {
                  if ((*hit)[k] == kNoTriangle) continue;
                  benchmark::DoNotOptimize(hitOf(scene.blisk->triangle((*hit)[k]), scene.segments[k]));
                }
              },
          .counters = {{"exact_tests", part}, {"bytes", part * bytesOf(1)}}};
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(
      argc, argv,
      {withBound(booleanTask("limit-boolean", &Scene::path, false),
                 [](const Scene& scene) { return pairsTrial(scene, false); }),
       withBound(contactsTask("limit-contacts"), [](const Scene& scene) { return pairsTrial(scene, true); }),
       withBound(distanceTask("limit-distance", false), distanceTrial),
       withBound(rayTask("limit-ray"), hitsTrial)});
}
