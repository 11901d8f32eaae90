// Collision, pose by pose along the path.
#include "boolean.h"

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv, {booleanTask("boolean-path", &Scene::path, true)});
}
