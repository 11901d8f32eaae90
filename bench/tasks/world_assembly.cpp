// Surfaces that lie along each other: a step of a Bullet world in which an M16 nut runs down a bolt.
#include <memory>

#include "timed_task.h"

namespace octoblisk::bench {
namespace {

Trial prepare(const Scene& scene, const Contender& contender) {
  const std::shared_ptr<AssemblyQuery> query = contender.assembly(scene);
  constexpr std::size_t kSteps = 144;  // of 1/240 s: the nut runs down by 1.7 mm
  query->restart();
  for (std::size_t k = 0; k < kSteps; ++k) query->step();
  const double sunk = query->sunk() / query->expectedSunk();
  const bool is_right = query->offHelix() <= query->play() && sunk > 0.9 && sunk < 1.1;
  return {.questions = kSteps,
          .ask =
              [query](std::size_t k) {
                if (k == 0) query->restart();
                query->step();
              },
          .differences = is_right ? 0u : 1u,
          .counters = {{"off_helix_mm", query->offHelix()},
                       {"sunk_mm", query->sunk()},
                       {"expected_sunk_mm", query->expectedSunk()}}};
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  const auto can_do = [](const Contender& contender) { return static_cast<bool>(contender.assembly); };
  return runTimedTasks(argc, argv,
                       {{.name = "world-assembly",
                         .can_do = can_do,
                         .prepare = prepare,
                         .scenes = {"1-bodies"},
                         .quick_scenes = {"1-bodies"},
                         .visits = 3}});
}
