// A step of a Bullet world in which convex hulls fall onto the blisk.
#include <memory>

#include "octoblisk/containment.h"
#include "timed_task.h"

namespace octoblisk::bench {
namespace {

constexpr std::size_t kSteps = 360;

Trial prepare(const Scene& scene, const Contender& contender) {
  const std::shared_ptr<WorldStepQuery> query = contender.world_step(scene);
  query->restart();
  std::size_t contacts = 0;
  for (std::size_t k = 0; k < kSteps; ++k) {
    query->step();
    contacts += query->contactsOnBlisk();
  }
  // No two worlds move alike, but in none a body may leave through the floor or into the blisk.
  const ClusteredOctree tree = ClusteredOctree::build(scene.blisk);
  const Surface blisk(tree);
  std::size_t lost = 0;
  double height = 0.0;
  const std::vector<Vec3> positions = query->positions();
  for (const Vec3& position : positions) {
    lost += position.z() < WorldStepQuery::kFloor || locate(blisk, position, Pose()) == PointLocation::inside;
    height += position.z() / static_cast<double>(positions.size());
  }
  return {.questions = kSteps,
          .ask =
              [query](std::size_t k) {
                if (k == 0) query->restart();
                query->step();
              },
          .differences = lost,
          .counters = {{"contacts_a_step", static_cast<double>(contacts) / kSteps}, {"mean_height", height}}};
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  const auto can_do = [](const Contender& contender) { return static_cast<bool>(contender.world_step); };
  return runTimedTask(argc, argv, {"world-step", can_do, prepare});
}
