// How far apart they are, each pose by itself.
#include "distance.h"

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv, {distanceTask("distance-cold", false)});
}
