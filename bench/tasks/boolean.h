// Whether belt and blisk touch, at each pose of a list.
#pragma once

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "reference.h"
#include "timed_task.h"

namespace octoblisk::bench {

inline TimedTask booleanTask(const std::string& name, std::vector<Pose> Scene::*poses_of) {
  const auto prepare = [poses_of](const Scene& scene, const Contender& contender) {
    const std::vector<Pose>& poses = scene.*poses_of;
    const std::shared_ptr<CollideQuery> query = contender.collide(scene);
    const Truth& truth = truthOf(scene, poses);
    std::size_t differences = 0;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      differences += query->collides(poses[k]) != (truth.touching_pairs[k] > 0);
    }
    return Trial{
        .questions = poses.size(),
        .ask = [query, &poses](std::size_t k) { benchmark::DoNotOptimize(query->collides(poses[k])); },
        .differences = differences,
        .counters = {{"hit_rate", truth.hit_rate}, {"near_rate", truth.near_rate}}};
  };
  return {name, [](const Contender& contender) { return static_cast<bool>(contender.collide); }, prepare};
}

}  // namespace octoblisk::bench
