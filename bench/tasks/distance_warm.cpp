// Distance, with the nearest triangles of the previous pose as a hint.
#include "distance.h"

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv, {distanceTask("distance-warm", true)});
}
