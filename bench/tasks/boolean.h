// Collision of belt and blisk at each pose of a list.
#pragma once

#include <benchmark/benchmark.h>

#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "mean_cost.h"
#include "reference.h"
#include "timed_task.h"

namespace octoblisk::bench {

inline TimedTask booleanTask(const std::string& name, std::vector<Pose> Scene::*poses_of, bool warm) {
  const auto prepare = [poses_of, warm](const Scene& scene, const Contender& contender) {
    const std::vector<Pose>& poses = scene.*poses_of;
    const std::shared_ptr<CollideQuery> query = contender.collide(scene);
    const Truth& truth = truthOf(scene, poses);
    std::size_t differences = 0;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      differences += query->collides(poses[k], warm) != (truth.touching_pairs[k] > 0);
    }
    const double pairs = std::accumulate(truth.touching_pairs.begin(), truth.touching_pairs.end(), 0.0);
    Trial trial{.questions = poses.size(),
                .ask = [query, warm,
                        &poses](std::size_t k) { benchmark::DoNotOptimize(query->collides(poses[k], warm)); },
                .differences = differences,
                .counters = {{"hit_rate", truth.hit_rate},
                             {"near_rate", truth.near_rate},
                             {"pairs_a_pose", pairs / static_cast<double>(poses.size())}}};
    trial.counters.merge(meanCost(*query, poses));
    return trial;
  };
  return {name, [](const Contender& contender) { return static_cast<bool>(contender.collide); }, prepare};
}

}  // namespace octoblisk::bench
