// Moving concave bodies on moving concave bodies: a step of a Bullet world in which 64 tori, gears, brackets
// and bumpy stones fall onto each other and onto a concave floor.
#include <memory>

#include "timed_task.h"

namespace octoblisk::bench {
namespace {

Trial prepare(const Scene& scene, const Contender& contender) {
  const std::shared_ptr<PileQuery> query = contender.pile(scene);
  constexpr std::size_t kSteps = 240;  // of 1/60 s: the bodies fall in the first half and lie in the second
  query->restart();
  for (std::size_t k = 0; k < kSteps; ++k) query->step();
  return {.questions = kSteps,
          .ask =
              [query](std::size_t k) {
                if (k == 0) query->restart();
                query->step();
              },
          .differences = static_cast<std::size_t>(query->fallen()),
          .counters = {{"bodies", static_cast<double>(query->bodies())}, {"depth_m", query->depth()}}};
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  const auto can_do = [](const Contender& contender) { return static_cast<bool>(contender.pile); };
  return runTimedTasks(argc, argv,
                       {{.name = "world-pile",
                         .can_do = can_do,
                         .prepare = prepare,
                         .scenes = {"64-bodies"},
                         .quick_scenes = {"64-bodies"},
                         .visits = 3}});
}
