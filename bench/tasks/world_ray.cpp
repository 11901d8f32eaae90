// Every fiftieth of the same segments as a ray of a Bullet world: rayTest. GImpact takes a millisecond for
// each.
#include "ray.h"

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  const auto can_do = [](const Contender& contender) { return static_cast<bool>(contender.world_ray); };
  const auto prepare = [](const Scene& scene, const Contender& contender) {
    return rayTrial(std::shared_ptr<WorldRayQuery>(contender.world_ray(scene)), scene, 50);
  };
  return runTimedTasks(argc, argv,
                       {{.name = "world-ray", .can_do = can_do, .prepare = prepare, .scenes = {"300k"}}});
}
