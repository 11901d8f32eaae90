// A task that is timed: every contender is asked the same questions, in turns with the others.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "contender.h"

namespace octoblisk::bench {

/// A contender that is ready to be asked.
struct Trial {
  std::size_t questions = 1;             ///< a pass asks all of them, in order
  std::size_t asked_at_once = 1;         ///< short ones come in bundles; times are told for each of a bundle
  std::function<void(std::size_t)> ask;  ///< asks one, or one bundle
  std::optional<std::size_t> differences = {};  ///< answers that are not the reference's; none: not compared
  std::map<std::string, double> counters = {};  ///< what else there is to tell of the questions
};

struct TimedTask {
  std::string name;
  std::function<bool(const Contender&)> can_do;
  std::function<Trial(const Scene&, const Contender&)> prepare;  ///< compares the answers; is not timed
  bool on_threads =
      false;  ///< contenders may use several: not pinned to a core, and passes taken by the clock
  std::vector<std::string> scenes = {"50k", "300k", "1500k"};
  std::vector<std::string> quick_scenes = {"50k"};
  std::size_t poses = 0;   ///< about how many of the path; 0: all
  std::string group = {};  ///< whose contenders take part
  std::function<bool(const Contender&, const std::string& scene)> takes_part = {};  ///< empty: in all scenes
  int visits = 0;  ///< of long passes; 0: as many as the session says
};

/// The main function of a program of one task, or of several that are run scene by scene. Benchmarks are
/// named task/scene/contender. Each repetition is one visit to a contender, the visits are shuffled, and a
/// row tells of the pass whose mean is the median of all passes: task, scene, contender, mean_us and
/// median_us of a question, ratio (of the mean to ours), answers_equal.
///
/// A pass is taken by the thread's processor time, which other work on the machine disturbs less, a question
/// by the clock. Both include the clock's reading, about 20 ns.
int runTimedTasks(int argc, char** argv, const std::vector<TimedTask>& tasks);

}  // namespace octoblisk::bench
