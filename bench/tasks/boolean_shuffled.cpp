// Whether they touch, each pose at another place of the blisk than the one before.
#include "boolean.h"

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv, {booleanTask("boolean-shuffled", &Scene::shuffled, false)});
}
