// The first triangle that random segments hit.
#include "ray.h"

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv, {rayTask("ray")});
}
