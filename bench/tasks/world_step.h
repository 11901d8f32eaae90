// A step of a Bullet world in which convex hulls fall onto the blisk.
#pragma once

#include <memory>

#include "octoblisk/containment.h"
#include "timed_task.h"

namespace octoblisk::bench {

/// Times `steps` steps. Each step is a query.
inline Trial worldStepTrial(const Scene& scene, const Contender& contender, std::size_t steps) {
  const std::shared_ptr<WorldStepQuery> query = contender.world_step(scene);
  const std::size_t bodies = scene.bodies;
  query->restart(bodies);
  std::size_t contacts = 0;
  for (std::size_t k = 0; k < steps; ++k) {
    query->step();
    contacts += query->contactsOnBlisk();
  }
  // Motion differs between worlds, but in none may a body fall through the floor or enter the blisk. The
  // floor is Bullet's plane, and no contender's.
  const ClusteredOctree tree = ClusteredOctree::build(scene.blisk);
  const Surface blisk(tree);
  std::size_t inside = 0, below = 0;
  double height = 0.0;
  const std::vector<Vec3> positions = query->positions();
  for (const Vec3& position : positions) {
    below += position.z() < WorldStepQuery::kFloor;
    inside += locate(blisk, position, Pose()) == PointLocation::inside;
    height += position.z() / static_cast<double>(positions.size());
  }
  return {.questions = steps,
          .ask =
              [query, bodies](std::size_t k) {
                if (k == 0) query->restart(bodies);
                query->step();
              },
          .differences = inside + below,
          .counters = {{"bodies", static_cast<double>(bodies)},
                       {"inside", static_cast<double>(inside)},
                       {"below_floor", static_cast<double>(below)},
                       {"contacts_a_step", static_cast<double>(contacts) / static_cast<double>(steps)},
                       {"mean_height", height}}};
}

inline bool canStep(const Contender& contender) { return static_cast<bool>(contender.world_step); }

}  // namespace octoblisk::bench
