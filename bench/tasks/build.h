// Building the structure over the blisk, from a mesh in the library's own layout.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ray.h"
#include "reference.h"
#include "timed_task.h"

namespace octoblisk::bench {

/// The number of wrong answers from structures that the contender builds in the same way: of rays, or else of
/// collisions. Empty if the contender supports neither.
inline std::optional<std::size_t> wrongAnswers(const Scene& scene, const Contender& contender) {
  if (contender.ray) return rayTrial(std::shared_ptr<RayQuery>(contender.ray(scene)), scene, 50).differences;
  if (contender.collide) {
    const auto query = contender.collide(scene);
    const Truth& truth = truthOf(scene, scene.path);
    std::size_t wrong = 0;
    for (std::size_t k = 0; k < scene.path.size(); ++k)
      wrong += query->collides(scene.path[k], false) != (truth.touching_pairs[k] > 0);
    return wrong;
  }
  return std::nullopt;
}

/// Uses as many threads as the library chooses.
inline TimedTask buildTask(const std::string& name) {
  const auto prepare = [](const Scene& scene, const Contender& contender) {
    const std::shared_ptr<BuildQuery> query = contender.build(scene);
    return Trial{.ask = [query](std::size_t) { query->build(); },
                 .differences = wrongAnswers(scene, contender)};
  };
  const auto can_do = [](const Contender& contender) { return static_cast<bool>(contender.build); };
  return {.name = name, .can_do = can_do, .prepare = prepare, .on_threads = true, .poses = 220};
}

}  // namespace octoblisk::bench
