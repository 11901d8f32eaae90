// Contact points of belt and blisk in a Bullet world, pose by pose along the path.
#include <benchmark/benchmark.h>

#include <memory>

#include "reference.h"
#include "timed_task.h"

namespace octoblisk::bench {
namespace {

Trial prepare(const Scene& scene, const Contender& contender) {
  const std::shared_ptr<WorldContactsQuery> query = contender.world_contacts(scene);
  const Truth& truth = truthOf(scene, scene.path);
  std::size_t differences = 0, points = 0;
  for (std::size_t k = 0; k < scene.path.size(); ++k) {
    const std::size_t found = query->points(scene.path[k]);
    differences += (found > 0) != (truth.touching_pairs[k] > 0);
    points += found;
  }
  return {
      .questions = scene.path.size(),
      .ask = [query, &scene](std::size_t k) { benchmark::DoNotOptimize(query->points(scene.path[k])); },
      .differences = differences,
      .counters = {{"hit_rate", truth.hit_rate},
                   {"points_a_pose", static_cast<double>(points) / static_cast<double>(scene.path.size())}}};
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  const auto can_do = [](const Contender& contender) { return static_cast<bool>(contender.world_contacts); };
  return runTimedTasks(argc, argv, {{"world-contacts", can_do, prepare}});
}
