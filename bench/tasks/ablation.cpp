// Compares OctoBlisk with variants that change one thing: collision along the path, all pairs, distance,
// rays.
#include "boolean.h"
#include "contacts.h"
#include "distance.h"
#include "ray.h"

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  std::vector<TimedTask> tasks = {booleanTask("ablation-boolean", &Scene::path, true),
                                  contactsTask("ablation-contacts"), distanceTask("ablation-distance", true),
                                  rayTask("ablation-ray")};
  for (TimedTask& task : tasks) {
    task.group = "ablation";
    task.scenes = {"300k"};
    task.poses = 440;
  }
  return runTimedTasks(argc, argv, tasks);
}
