// Refits the structure to the blisk bent by up to 0.5 mm, and back.
#include <memory>
#include <vector>

#include "reference.h"
#include "timed_task.h"

namespace octoblisk::bench {
namespace {

/// Whether the belt touches the bent and the original blisk at each pose.
struct Touches {
  std::vector<bool> bent, unbent;
};

const Touches& touchesOf(const Scene& scene) {
  static const Touches touches = [&] {
    const auto bent_blisk = bent(*scene.blisk);
    const Reference bent_reference(*bent_blisk), reference(*scene.blisk);
    Touches found;
    for (const Pose& pose : scene.path) {
      found.bent.push_back(bent_reference.touchingPairs(*scene.belt, pose) > 0);
      found.unbent.push_back(reference.touchingPairs(*scene.belt, pose) > 0);
    }
    return found;
  }();
  return touches;
}

Trial prepare(const Scene& scene, const Contender& contender) {
  const std::shared_ptr<RefitQuery> query = contender.refit(scene);
  const Touches& touches = touchesOf(scene);
  std::size_t differences = 0, changed = 0;
  for (const bool is_bent : {true, false}) {
    query->refit(is_bent);
    for (std::size_t k = 0; k < scene.path.size(); ++k) {
      differences += query->touches(scene.path[k]) != (is_bent ? touches.bent[k] : touches.unbent[k]);
    }
  }
  for (std::size_t k = 0; k < scene.path.size(); ++k) changed += touches.bent[k] != touches.unbent[k];
  return {.questions = 2,
          .ask = [query](std::size_t k) { query->refit(k == 0); },
          .differences = differences,
          .counters = {{"changed", static_cast<double>(changed) / static_cast<double>(scene.path.size())}}};
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  const auto can_do = [](const Contender& contender) { return static_cast<bool>(contender.refit); };
  return runTimedTasks(
      argc, argv,
      {{.name = "refit", .can_do = can_do, .prepare = prepare, .scenes = {"300k", "1500k"}, .poses = 220}});
}
