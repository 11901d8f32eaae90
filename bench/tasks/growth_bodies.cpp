// How the time of a Bullet step grows with the number of bodies, 1 to 10,000, that fall onto the blisk of
// 50,000 triangles. The rows' `size` is that number.
#include "world_step.h"

namespace octoblisk::bench {
namespace {

/// Times the steps in which the bodies fall and settle. These take longest.
Trial prepare(const Scene& scene, const Contender& contender) {
  Trial trial = worldStepTrial(scene, contender, 60);
  trial.counters["size"] = static_cast<double>(scene.bodies);
  return trial;
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  TimedTask task = {.name = "growth-bodies",
                    .can_do = canStep,
                    .prepare = prepare,
                    .scenes = {"1-bodies", "10-bodies", "100-bodies", "1000-bodies", "10000-bodies"},
                    .quick_scenes = {"1-bodies", "10-bodies", "100-bodies"},
                    .takes_part =
                        [](const Contender& contender, const std::string& scene) {
                          return contender.name != "scaled-bvh" &&
                                 (contender.name != "gimpact" || scene != "10000-bodies");
                        },
                    .visits = 1};
  return runTimedTasks(argc, argv, {task});
}
