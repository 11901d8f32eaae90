#include "report/versions.h"

#include <LinearMath/btScalar.h>

#include <Eigen/Core>

namespace octoblisk::demos {

namespace {

#ifdef __clang__
constexpr const char* kCompiler = __VERSION__;  // includes its name
#else
constexpr const char* kCompiler = "GCC " __VERSION__;
#endif

}  // namespace

Table versionsTable() {
  const int bullet = btGetVersion();
  const std::string eigen = std::to_string(EIGEN_WORLD_VERSION) + '.' + std::to_string(EIGEN_MAJOR_VERSION) +
                            '.' + std::to_string(EIGEN_MINOR_VERSION);
  return {.name = "versions",
          .caption = "Versions",
          .rows = {{"octoblisk", OCTOBLISK_VERSION},
                   {"Bullet",
                    std::to_string(bullet / 100) + '.' + std::to_string(bullet % 100) + ", double precision"},
                   {"Eigen", eigen},
                   {"compiler", kCompiler}}};
}

}  // namespace octoblisk::demos
