#include "dynamics/measure.h"

#include <algorithm>
#include <ctime>
#include <vector>

namespace octoblisk::bench {
namespace {

constexpr int kSamples = 30;  // approximate number of samples over time
constexpr int kLate = 100;    // steps

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double msOf(std::clock_t time) { return 1e3 * static_cast<double>(time) / CLOCKS_PER_SEC; }

}  // namespace

Row measured(DynamicsScene& scene, int steps) {
  std::clock_t spent = 0, awake = 0;
  int awake_steps = 0;
  Row asleep_after;  // null
  std::vector<double> late, times, energies, depths;
  const int interval = std::max(1, steps / kSamples);
  for (int step = 1; step <= steps; ++step) {
    const std::clock_t begin = std::clock();
    scene.step();
    const std::clock_t took = std::clock() - begin;
    spent += took;
    if (asleep_after.is_null()) {
      awake += took;
      ++awake_steps;
    }
    if (asleep_after.is_null() && scene.asleep() == scene.bodies()) asleep_after = step;
    if (step > steps - kLate) late.push_back(scene.kineticEnergy());
    if (step % interval != 0 && step != steps) continue;
    times.push_back(step * scene.timeStep());
    energies.push_back(scene.kineticEnergy());
    depths.push_back(scene.depth());
  }
  Row row = {{"bodies", scene.bodies()},
             {"steps", steps},
             {"step_ms", msOf(spent) / steps},
             {"awake_step_ms", msOf(awake) / awake_steps},
             {"asleep_after_steps", asleep_after},
             {"late_energy_j", median(late)},
             {"depth_m", depths.back()},
             {"points", scene.contactPoints()},
             {"manifolds", scene.manifolds()},
             {"lost", scene.lost()},
             {"asleep", scene.asleep()}};
  row["figures"] = Row::object();
  for (const Figure& figure : scene.figures()) row["figures"][figure.name] = figure.value;
  row["time_s"] = times;
  row["energy_j"] = energies;
  row["depth_over_time_m"] = depths;
  return row;
}

Row stepsUntilAsleep(DynamicsScene& scene, int steps) {
  for (int step = 1; step <= steps; ++step) {
    scene.step();
    if (scene.asleep() == scene.bodies()) return step;
  }
  return {};
}

}  // namespace octoblisk::bench
