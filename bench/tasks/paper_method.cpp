// Compares the paper's detection with OctoBlisk's: time, range and false alarms.
#include <benchmark/benchmark.h>

#include <memory>

#include "reference.h"
#include "timed_task.h"

namespace octoblisk::bench {
namespace {

Trial prepare(const Scene& scene, const Contender& contender) {
  const std::shared_ptr<BoxQuery> query = contender.boxes(scene);
  const Truth& truth = truthOf(scene, scene.path);
  std::size_t false_alarms = 0, missed = 0, clear = 0, contradictions = 0;
  double volume = 0.0, leaves = 0.0;
  for (std::size_t k = 0; k < scene.path.size(); ++k) {
    const BoxQuery::Left left = query->left(scene.path[k]);
    const bool touches = truth.touching_pairs[k] > 0;
    contradictions += query->mayTouch(scene.path[k]) != (left.leaves > 0);
    clear += !touches;
    false_alarms += left.leaves > 0 && !touches;
    missed += left.leaves == 0 && touches;
    volume += left.volume;
    leaves += static_cast<double>(left.leaves);
  }
  const auto poses = static_cast<double>(scene.path.size());
  return {.questions = scene.path.size(),
          .ask = [query, &scene](std::size_t k) { benchmark::DoNotOptimize(query->mayTouch(scene.path[k])); },
          .differences = false_alarms + missed + contradictions,
          .counters = {{"clear_poses", static_cast<double>(clear)},
                       {"false_alarms", static_cast<double>(false_alarms)},
                       {"missed", static_cast<double>(missed)},
                       {"range_mm3", query->range()},
                       {"leaves_left", leaves / poses},
                       {"volume_left_mm3", volume / poses}}};
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  const auto can_do = [](const Contender& contender) { return static_cast<bool>(contender.boxes); };
  return runTimedTasks(argc, argv,
                       {{.name = "paper-method",
                         .can_do = can_do,
                         .prepare = prepare,
                         .scenes = {"50k", "300k"},
                         .poses = 440,
                         .group = "paper"}});
}
