// The closest points of belt and blisk in a Bullet world at the clear poses of the path: contactPairTest with
// a threshold.
#include "distance.h"

namespace octoblisk::bench {
namespace {

Trial prepare(const Scene& scene, const Contender& contender) {
  constexpr double kThreshold = 1.0, kTolerance = 0.01;  // mm; Bullet computes in single precision
  const std::shared_ptr<WorldClosestQuery> query = contender.world_closest(scene);
  const Distances& distances = distancesOf(scene);
  std::size_t differences = 0, within = 0;
  for (std::size_t k = 0; k < distances.poses.size(); ++k) {
    const double truth = std::min(distances.truth[k], kThreshold);
    within += truth < kThreshold;
    const double found = std::min(query->nearest(distances.poses[k], kThreshold), kThreshold);
    differences += !(std::abs(found - truth) <= kTolerance);
  }
  return {
      .questions = distances.poses.size(),
      .ask = [query, &distances](
                 std::size_t k) { benchmark::DoNotOptimize(query->nearest(distances.poses[k], kThreshold)); },
      .differences = differences,
      .counters = {
          {"within_threshold", static_cast<double>(within) / static_cast<double>(distances.poses.size())}}};
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  const auto can_do = [](const Contender& contender) { return static_cast<bool>(contender.world_closest); };
  return runTimedTasks(argc, argv,
                       {{.name = "world-closest", .can_do = can_do, .prepare = prepare, .scenes = {"300k"}}});
}
