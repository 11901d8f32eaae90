// One run of a benchmark program: its options, the core it is pinned to, and the rows that it leaves.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "report/rows.h"

namespace octoblisk::bench {

/// The options of every program, beside Google Benchmark's own:
///   --rows FILE    where the rows go; those of other tasks and scenes that are there already stay
///   --scenes A,B   these alone
///   --core N       the core to be pinned to; -1: none
///   --poses N      about how many poses to keep of a scene's path; 0: as many as the task takes
///   --quick        fewer scenes, poses and repetitions: to see that all works, not to tell what is faster
struct SessionOptions {
  std::string rows_file = {};
  std::vector<std::string> scenes = {};  ///< empty: all of the task
  int core = -1;
  std::size_t poses = 0;
  bool quick = false;
  std::vector<std::string> of_google = {};  ///< Google Benchmark's, after the program's name
};

/// Pinned by default to the last core, or to none. Exits with a message on an option that lacks its value.
SessionOptions sessionOptions(int argc, char** argv, bool pinned = true);

/// Runs `run` for each of the scenes in a process of its own, so that what one takes of memory, or a library
/// that crashes in it, is no matter to the next. Returns the exit code: 1 where one failed, with a message.
int forEachScene(const SessionOptions& options, const std::vector<std::string>& scenes,
                 const std::function<void(const std::string&)>& run);

/// Google Benchmark for one scene. Its JSON, --benchmark_out=NAME.json, goes to NAME-SCENE.json.
class Session {
 public:
  /// Pins the process, and tells Google Benchmark the options and the versions of all contenders. Exits with
  /// a message on an option that is not known.
  Session(const SessionOptions& options, const std::string& scene);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Runs what was registered with Google Benchmark.
  void run() const;

  /// Prints the rows, and merges them into the file.
  void finish(const Rows& rows) const;

 private:
  std::string rows_file_;
  std::vector<std::string> arguments_;  // Google Benchmark keeps a pointer to the program's name
};

}  // namespace octoblisk::bench
