// Collision, with each pose at a different place of the blisk than the previous one.
#include "boolean.h"

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv, {booleanTask("boolean-shuffled", &Scene::shuffled, false)});
}
