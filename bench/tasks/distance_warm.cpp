// How far apart they are, where the nearest triangles at the pose before are a hint.
#include "distance.h"

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv, {distanceTask("distance-warm", true)});
}
