// One run of a benchmark binary: its options, the core it is pinned to, and the rows that it leaves.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace octoblisk::bench {

/// A line of the results: task, scene, contender, and figures.
using Row = nlohmann::ordered_json;

/// Options beside Google Benchmark's:
///   --rows FILE   where the rows go, as a JSON array
///   --core N      the core to be pinned to; -1: none
///   --poses N     about how many poses to keep of a scene's path; by default all
class Session {
 public:
  /// Takes the options and pins the process: by default to the last core, or to none. Exits with a message on
  /// an option that is not known.
  Session(int argc, char** argv, bool pinned = true);

  std::size_t poses() const { return poses_; }

  /// Runs what was registered with Google Benchmark.
  void run();

  /// Writes the rows and returns the exit code.
  int finish(const std::vector<Row>& rows) const;

 private:
  std::string rows_file_;
  int core_;
  std::size_t poses_ = 0;
};

}  // namespace octoblisk::bench
