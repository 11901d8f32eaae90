// Distance, each pose independently.
#include "distance.h"

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv, {distanceTask("distance-cold", false)});
}
