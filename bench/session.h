// One run of a benchmark program: its options, its core, and its rows.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "report/rows.h"

namespace octoblisk::bench {

/// The options of every program, in addition to Google Benchmark's:
///   --rows FILE    file for the rows; its rows of other tasks and scenes stay
///   --scenes A,B   run only these scenes
///   --core N       pin the process to this core; -1: to none
///   --poses N      approximate number of poses of a scene's path; 0: the task's own number
///   --quick        fewer scenes, poses and repetitions, to check that everything works, not to compare times
struct SessionOptions {
  std::string rows_file = {};
  std::vector<std::string> scenes = {};  ///< empty: all of the task
  int core = -1;
  std::size_t poses = 0;
  bool quick = false;
  std::vector<std::string> of_google = {};  ///< Google Benchmark's options, after the program's name
};

/// Reads the options. By default, pins to the last core if `pinned`. Exits with a message if an option lacks
/// its value.
SessionOptions sessionOptions(int argc, char** argv, bool pinned = true);

/// Runs `run` for each scene in a separate process, so that neither the memory of one scene nor a crash
/// affects the next. Returns the exit code: 1, with a message, if a scene failed.
int forEachScene(const SessionOptions& options, const std::vector<std::string>& scenes,
                 const std::function<void(const std::string&)>& run);

/// Google Benchmark for one scene. Its JSON, --benchmark_out=NAME.json, goes to NAME-SCENE.json.
class Session {
 public:
  /// Pins the process, and passes the options and all contenders' versions to Google Benchmark. Exits with a
  /// message if an option is unknown.
  Session(const SessionOptions& options, const std::string& scene);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Runs the benchmarks registered with Google Benchmark.
  void run() const;

  /// Prints the rows and merges them into the file.
  void finish(const Rows& rows) const;

 private:
  std::string rows_file_;
  std::vector<std::string> arguments_;  // Google Benchmark keeps a pointer to the program's name
};

}  // namespace octoblisk::bench
