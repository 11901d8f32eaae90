// Building the structure over the blisk, from a mesh in the library's own layout.
#pragma once

#include <memory>
#include <string>

#include "timed_task.h"

namespace octoblisk::bench {

/// On as many threads as the library takes.
inline TimedTask buildTask(const std::string& name) {
  const auto prepare = [](const Scene& scene, const Contender& contender) {
    const std::shared_ptr<BuildQuery> query = contender.build(scene);
    return Trial{.ask = [query](std::size_t) { query->build(); }};
  };
  const auto can_do = [](const Contender& contender) { return static_cast<bool>(contender.build); };
  return {.name = name, .can_do = can_do, .prepare = prepare, .on_threads = true};
}

}  // namespace octoblisk::bench
