// Surfaces that lie along each other: an M16 nut runs down a bolt. A step of a world of Bullet or ODE, and
// the triangle pairs that touch on the way.
#include <memory>

#include "contacts.h"
#include "timed_task.h"

namespace octoblisk::bench {
namespace {

constexpr const char* kScene = "nut-on-bolt";

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
                       {"turns", query->turns()},
                       {"sunk_mm", query->sunk()},
                       {"expected_sunk_mm", query->expectedSunk()}}};
}

TimedTask stepTask() {
  return {.name = "world-assembly",
          .can_do = [](const Contender& contender) { return static_cast<bool>(contender.assembly); },
          .prepare = prepare,
          .scenes = {kScene},
          .quick_scenes = {kScene},
          .visits = 3};
}

/// The geometry alone.
TimedTask pairsTask() {
  TimedTask task = contactsTask("assembly-contacts");
  task.scenes = task.quick_scenes = {kScene};
  task.takes_part = [](const Contender& contender, const std::string&) {
    return contender.name != "bullet-bvh";  // makes hulls of the belt's stations
  };
  return task;
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv, {stepTask(), pairsTask()});
}
