// Building the structure over the blisk, from a mesh in the library's own layout.
#include <memory>

#include "timed_task.h"

namespace octoblisk::bench {
namespace {

Trial prepare(const Scene& scene, const Contender& contender) {
  const std::shared_ptr<BuildQuery> query = contender.build(scene);
  return {.ask = [query](std::size_t) { query->build(); }};
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  const auto can_do = [](const Contender& contender) { return static_cast<bool>(contender.build); };
  return runTimedTask(argc, argv, {"build", can_do, prepare, true});
}
