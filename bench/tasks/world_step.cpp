// A step of a Bullet world in which 200 or 1,000 convex hulls fall onto the blisk.
#include "world_step.h"

namespace octoblisk::bench {
namespace {

Trial prepare(const Scene& scene, const Contender& contender) {
  return worldStepTrial(scene, contender, 360);
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv,
                       {{.name = "world-step",
                         .can_do = canStep,
                         .prepare = prepare,
                         .scenes = {"50k", "300k", "1500k", "1000-bodies"},
                         .visits = 9}});
}
