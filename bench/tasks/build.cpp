// Building the structure over the blisk, from a mesh in the library's own layout.
#include "build.h"

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  return runTimedTasks(argc, argv, {buildTask("build")});
}
