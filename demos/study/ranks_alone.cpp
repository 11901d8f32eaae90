// Ranks without MPI.
#include <stdexcept>
#include <string>

#include "base/parallel.h"
#include "study/launch.h"
#include "study/ranks.h"

namespace octoblisk::demos {

using namespace detail;

struct Ranks::Joined {};

Ranks::Ranks() {
  if (launchedAs().count == 1) return;
  throw std::runtime_error(
      "the launcher started " + std::to_string(launchedAs().count) +
      " processes, but this command was built without MPI: build it with -DOCTOBLISK_BUILD_MPI=ON");
}

Ranks::~Ranks() = default;

int Ranks::rank() const { return 0; }
int Ranks::count() const { return 1; }
int Ranks::threadsEach() const { return threadCount(0); }
void Ranks::together(const std::function<void()>& step) { step(); }

SharedBytes Ranks::oncePerNode(const std::function<std::vector<std::byte>()>& make) {
  return alignedCopy(make());
}

bool Ranks::haveAllTheSame(std::uint64_t) { return true; }

}  // namespace octoblisk::demos
