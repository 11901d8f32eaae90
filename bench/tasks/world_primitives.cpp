// Contacts of Bullet's convex primitives with small closed meshes, of sizes common in games: contactPairTest.
// Each primitive is a task.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>

#include "reference.h"
#include "timed_task.h"

namespace octoblisk::bench {
namespace {

Trial prepare(const Scene& scene, const Contender& contender, Primitive primitive) {
  constexpr double kTolerance = 1e-4;  // of depths, which Bullet computes in single precision
  constexpr std::size_t kBundle = 10;
  Scene with_primitive = scene;
  with_primitive.primitive = primitive;
  const std::shared_ptr<WorldPrimitiveQuery> query = contender.world_primitive(with_primitive);
  const PrimitiveTruth& truth = truthOf(scene, primitive);
  const auto poses = static_cast<double>(truth.poses.size());
  std::size_t differences = 0;
  for (std::size_t k = 0; k < truth.poses.size(); ++k) {
    const double found = query->nearest(truth.poses[k]);
    const bool is_deep_as =
        !truth.touches[k] || truth.distances.empty() || std::abs(found - truth.distances[k]) <= kTolerance;
    differences += (found <= 0.0) != truth.touches[k] || !is_deep_as;
  }
  return {.questions = truth.poses.size() / kBundle,
          .asked_at_once = kBundle,
          .ask =
              [query, &truth](std::size_t bundle) {
                for (std::size_t k = bundle * kBundle; k < (bundle + 1) * kBundle; ++k)
                  benchmark::DoNotOptimize(query->nearest(truth.poses[k]));
              },
          .differences = differences,
          .counters = {{"hit_rate", static_cast<double>(truth.hits) / poses},
                       {"left_out", static_cast<double>(scene.path.size()) - poses}}};
}

TimedTask taskOf(const std::string& name, Primitive primitive) {
  return {.name = "world-" + name,
          .can_do = [](const Contender& contender) { return static_cast<bool>(contender.world_primitive); },
          .prepare = [primitive](const Scene& scene,
                                 const Contender& contender) { return prepare(scene, contender, primitive); },
          .scenes = {"500-triangles", "5000-triangles"},
          .quick_scenes = {"500-triangles"},
          .visits = 25};  // of a few milliseconds each
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv,
                       {taskOf("sphere", Primitive::sphere), taskOf("box", Primitive::box),
                        taskOf("capsule", Primitive::capsule), taskOf("cylinder", Primitive::cylinder),
                        taskOf("hull", Primitive::hull)});
}
