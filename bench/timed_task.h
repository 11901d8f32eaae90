// A timed task: all contenders answer the same queries, in turn.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "contender.h"

namespace octoblisk::bench {

/// A contender that is ready to answer.
struct Trial {
  std::size_t questions = 1;             ///< a pass runs all of them, in order
  std::size_t asked_at_once = 1;         ///< short queries run in bundles; times are per query of a bundle
  std::function<void(std::size_t)> ask;  ///< runs one query, or one bundle
  std::optional<std::size_t> differences = {};  ///< wrong answers; empty: not compared
  std::map<std::string, double> counters = {};  ///< further figures
};

struct TimedTask {
  std::string name;
  std::function<bool(const Contender&)> can_do;
  std::function<Trial(const Scene&, const Contender&)> prepare;  ///< compares the answers, untimed
  bool on_threads = false;                                       ///< no pinning; passes take wall-clock time
  std::vector<std::string> scenes = {"50k", "300k", "1500k"};
  std::vector<std::string> quick_scenes = {"50k"};
  std::size_t poses = 0;   ///< approximate number of the path's poses; 0: all
  std::string group = {};  ///< the group of contenders that take part
  std::function<bool(const Contender&, const std::string& scene)> takes_part = {};  ///< empty: in all scenes
  int visits = 0;  ///< number of visits, for long passes; 0: the session's number
};

/// The main function of a program with one or more tasks, which run scene by scene. Benchmarks are named
/// task/scene/contender. Each repetition is one visit to a contender. The visits are shuffled. A row
/// describes the pass with the median of all passes' means: task, scene, contender, mean_us and median_us of
/// a query, ratio (of the mean to OctoBlisk's), answers_equal.
///
/// A pass is measured in the thread's processor time, which other work on the machine disturbs less. A query
/// is measured in wall-clock time. Both include the clock reading, about 20 ns.
int runTimedTasks(int argc, char** argv, const std::vector<TimedTask>& tasks);

}  // namespace octoblisk::bench
