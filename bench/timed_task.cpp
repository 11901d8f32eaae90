#include "timed_task.h"

#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include "session.h"

namespace octoblisk::bench {
namespace {

struct Pass {
  double mean_us = 0.0;
  double median_us = 0.0;
};

/// A contender on a scene, prepared at its first visit.
struct Entrant {
  std::string scene;
  const Contender* contender = nullptr;
  std::optional<Trial> trial{};
  std::vector<Pass> passes{};
  double seconds = 0.0;  ///< of all passes
};

/// Whether further passes would add no information. An odd number of passes has a middle one.
bool areEnough(double seconds, std::size_t passes) {
  constexpr double kEnough = 8.0;  // s for each contender in a task on a scene
  return seconds > kEnough && passes % 2 == 1;
}

double threadSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <typename Values, typename Less>
auto medianOf(Values& values, Less less) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end(), less);
  return *middle;
}

void visit(benchmark::State& state, Entrant& entrant, bool by_the_clock) {
  using Clock = std::chrono::steady_clock;
  Trial& trial = *entrant.trial;
  std::vector<Clock::time_point> readings(trial.questions + 1);
  std::vector<double> micros(trial.questions);
  for (auto _ : state) {
    if (areEnough(entrant.seconds, entrant.passes.size())) {
      state.SetIterationTime(entrant.seconds / static_cast<double>(entrant.passes.size()));
      state.SetLabel("mean of the earlier passes; not run again");
      continue;
    }
    const double start = threadSeconds();
    readings[0] = Clock::now();
    for (std::size_t k = 0; k < trial.questions; ++k) {
      trial.ask(k);
      readings[k + 1] = Clock::now();
    }
    const double seconds = by_the_clock
                               ? std::chrono::duration<double>(readings.back() - readings.front()).count()
                               : threadSeconds() - start;
    state.SetIterationTime(seconds);
    entrant.seconds += seconds;
    for (std::size_t k = 0; k < trial.questions; ++k) {
      micros[k] = std::chrono::duration<double, std::micro>(readings[k + 1] - readings[k]).count();
    }
    const double asked = static_cast<double>(trial.questions * trial.asked_at_once);
    entrant.passes.push_back(
        {1e6 * seconds / asked, medianOf(micros, std::less<>{}) / static_cast<double>(trial.asked_at_once)});
  }
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(trial.questions * trial.asked_at_once));
  for (const auto& [name, value] : trial.counters) state.counters[name] = value;
  if (trial.differences) state.counters["differences"] = static_cast<double>(*trial.differences);
}

Rows rowsOf(const std::string& task, std::vector<std::unique_ptr<Entrant>>& entrants) {
  Rows rows;
  std::map<std::string, double> ours;
  for (const auto& entrant : entrants) {
    if (entrant->passes.empty()) continue;
    const Pass pass =
        medianOf(entrant->passes, [](const Pass& a, const Pass& b) { return a.mean_us < b.mean_us; });
    if (entrant->contender->name == kOurs) ours[entrant->scene] = pass.mean_us;
    Row row = {{"task", task},
               {"scene", entrant->scene},
               {"contender", entrant->contender->name},
               {"mean_us", pass.mean_us},
               {"median_us", pass.median_us},
               {"ratio", nullptr},
               {"answers_equal", nullptr}};
    const auto base = ours.find(entrant->scene);
    if (base != ours.end()) row["ratio"] = pass.mean_us / base->second;
    if (const auto& differences = entrant->trial->differences) {
      row["answers_equal"] = *differences == 0;
      row["differences"] = *differences;
    }
    row["questions"] = entrant->trial->questions * entrant->trial->asked_at_once;
    row["passes"] = entrant->passes.size();
    const auto [least, most] = std::ranges::minmax(entrant->passes, {}, &Pass::mean_us);
    row["least_us"] = least.mean_us;
    row["most_us"] = most.mean_us;
    for (const auto& [name, value] : entrant->trial->counters) row[name] = value;
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Registers every contender that takes part in the task on the scene.
void addEntrants(const TimedTask& task, const std::string& scene, const SessionOptions& options,
                 std::vector<std::unique_ptr<Entrant>>& entrants) {
  const std::size_t all = options.quick ? 220 : task.poses;
  const SceneSize size = {.poses = options.poses > 0 ? options.poses : all, .quick = options.quick};
  for (const Contender& contender : contenders(task.group)) {
    if (!task.can_do(contender) || (task.takes_part && !task.takes_part(contender, scene))) continue;
    Entrant* entrant = entrants.emplace_back(std::make_unique<Entrant>(scene, &contender)).get();
    const std::string name = task.name + '/' + scene + '/' + contender.name;
    auto* const registered =
        benchmark::RegisterBenchmark(name.c_str(),
                                     [entrant, &task, size](benchmark::State& state) {
                                       if (!entrant->trial) {
                                         entrant->trial = task.prepare(sceneNamed(entrant->scene, size),
                                                                       *entrant->contender);
                                       }
                                       visit(state, *entrant, task.on_threads);
                                     })
            ->Iterations(1)
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
    if (task.visits > 0) registered->Repetitions(options.quick ? 1 : task.visits);
  }
}

}  // namespace

int runTimedTasks(int argc, char** argv, const std::vector<TimedTask>& tasks) {
  const SessionOptions options = sessionOptions(argc, argv, !tasks.front().on_threads);
  const auto scenesOf = [&](const TimedTask& task) {
    return options.quick ? task.quick_scenes : task.scenes;
  };
  std::vector<std::string> scenes;
  for (const TimedTask& task : tasks) {
    for (const std::string& scene : scenesOf(task)) {
      if (std::ranges::find(scenes, scene) == scenes.end()) scenes.push_back(scene);
    }
  }
  return forEachScene(options, scenes, [&](const std::string& scene) {
    const Session session(options, scene);
    std::vector<std::vector<std::unique_ptr<Entrant>>> entrants(tasks.size());
    for (std::size_t t = 0; t < tasks.size(); ++t) {
      const std::vector<std::string> its = scenesOf(tasks[t]);
      if (std::ranges::find(its, scene) != its.end()) addEntrants(tasks[t], scene, options, entrants[t]);
    }
    session.run();
    Rows rows;
    for (std::size_t t = 0; t < tasks.size(); ++t) {
      for (Row& row : rowsOf(tasks[t].name, entrants[t])) rows.push_back(std::move(row));
    }
    session.finish(rows);
  });
}

}  // namespace octoblisk::bench
