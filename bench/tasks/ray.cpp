// What straight ways from anywhere to anywhere meet first.
#include "ray.h"

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv, {rayTask("ray")});
}
