// All triangle pairs that touch, pose by pose along the path.
#pragma once

#include <benchmark/benchmark.h>

#include <memory>
#include <numeric>
#include <string>

#include "mean_cost.h"
#include "reference.h"
#include "timed_task.h"

namespace octoblisk::bench {

inline Trial prepareContacts(const Scene& scene, const Contender& contender) {
  const std::shared_ptr<ContactsQuery> query = contender.contacts(scene);
  const Truth& truth = truthOf(scene, scene.path);
  std::size_t differences = 0;
  for (std::size_t k = 0; k < scene.path.size(); ++k) {
    const std::size_t found = query->contacts(scene.path[k]);
    const std::size_t pairs = truth.touching_pairs[k];
    differences += query->countsPairs() ? found != pairs : (found > 0) != (pairs > 0);
  }
  const double pairs = std::accumulate(truth.touching_pairs.begin(), truth.touching_pairs.end(), 0.0);
  Trial trial{
      .questions = scene.path.size(),
      .ask = [query, &scene](std::size_t k) { benchmark::DoNotOptimize(query->contacts(scene.path[k])); },
      .differences = differences,
      .counters = {{"hit_rate", truth.hit_rate},
                   {"pairs_a_pose", pairs / static_cast<double>(scene.path.size())},
                   {"counts_pairs", query->countsPairs()}}};
  trial.counters.merge(meanCost(*query, scene.path));
  return trial;
}

inline TimedTask contactsTask(const std::string& name) {
  return {name, [](const Contender& contender) { return static_cast<bool>(contender.contacts); },
          prepareContacts};
}

}  // namespace octoblisk::bench
