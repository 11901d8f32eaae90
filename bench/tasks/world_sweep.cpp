// The first touch of the blisk by a ball swept through a Bullet world: convexSweepTest.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "reference.h"
#include "shared/meshes.h"
#include "timed_task.h"

namespace octoblisk::bench {
namespace {

constexpr double kRadius = 3.0;  // of the ball, mm

/// Segments of the ball's centre, and the reference's first touch on each.
struct Sweeps {
  std::vector<Segment> segments;
  std::vector<double> truth;
  std::size_t hits = 0;
};

/// Makes segments from up to 60 mm away towards points of the surface. Some end before it and some beyond it.
/// None starts within a millimetre of touching.
Sweeps makeSweeps(const Scene& scene, std::size_t count) {
  const Reference reference(*scene.blisk);
  std::mt19937_64 random(5);
  Sweeps sweeps;
  while (sweeps.segments.size() < count) {
    const Triangle triangle = scene.blisk->triangle(random() % scene.blisk->triangleCount());
    const Vec3 target = centroidOf(triangle);
    const Vec3 towards = testing::randomRotation(random).col(0);
    const Vec3 from = target - testing::uniform(random, 10.0, 60.0) * towards;
    const Vec3 to = from + testing::uniform(random, 0.4, 1.4) * (target - from);
    const Segment segment = {from.cast<float>().cast<double>(), to.cast<float>().cast<double>()};
    if (reference.distanceTo(segment.from, kRadius + 1.0) <= kRadius + 1.0) continue;
    sweeps.segments.push_back(segment);
    sweeps.truth.push_back(reference.firstTouch(segment, kRadius));
    sweeps.hits += sweeps.truth.back() < 1.0;
  }
  return sweeps;
}

const Sweeps& sweepsOf(const Scene& scene) {
  static std::map<const Scene*, Sweeps> known;
  const auto [entry, is_new] = known.try_emplace(&scene);
  if (is_new) entry->second = makeSweeps(scene, scene.segments.size() / 200);
  return entry->second;
}

Trial prepare(const Scene& scene, const Contender& contender) {
  constexpr double kTolerance = 0.02;  // mm: Bullet's sweeps are iterated in single precision
  const std::shared_ptr<WorldSweepQuery> query = contender.world_sweep(scene);
  const Sweeps& sweeps = sweepsOf(scene);
  std::size_t differences = 0;
  for (std::size_t k = 0; k < sweeps.segments.size(); ++k) {
    const Segment& segment = sweeps.segments[k];
    const double apart = std::abs(query->firstTouch(segment, kRadius) - sweeps.truth[k]);
    differences += !(apart * (segment.to - segment.from).norm() <= kTolerance);
  }
  return {
      .questions = sweeps.segments.size(),
      .ask = [query, &sweeps](
                 std::size_t k) { benchmark::DoNotOptimize(query->firstTouch(sweeps.segments[k], kRadius)); },
      .differences = differences,
      .counters = {
          {"hit_rate", static_cast<double>(sweeps.hits) / static_cast<double>(sweeps.segments.size())}}};
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  const auto can_do = [](const Contender& contender) { return static_cast<bool>(contender.world_sweep); };
  return runTimedTasks(argc, argv,
                       {{.name = "world-sweep", .can_do = can_do, .prepare = prepare, .scenes = {"300k"}}});
}
