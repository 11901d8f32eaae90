#include "session.h"

#include <benchmark/benchmark.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "contender.h"

namespace octoblisk::bench {
namespace {

[[noreturn]] void refuse(const std::string& message) {
  std::cerr << message << '\n';
  std::exit(2);
}

long numberIn(const std::string& option, const std::string& text) {
  try {
    std::size_t read = 0;
    const long number = std::stol(text, &read);
    if (read == text.size()) return number;
  } catch (const std::logic_error&) {
  }
  refuse(option + " needs a whole number, not '" + text + "'");
}

std::vector<std::string> partsOf(const std::string& list) {
  std::vector<std::string> parts;
  std::istringstream text(list);
  for (std::string part; std::getline(text, part, ',');) parts.push_back(part);
  return parts;
}

void pinTo(int core) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<std::size_t>(core), &cores);
  if (sched_setaffinity(0, sizeof cores, &cores) != 0) {
    refuse("cannot pin the process to core " + std::to_string(core) + ". Choose another one with --core");
  }
}

std::string processorName() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

std::string textOf(const Row& value) {
  if (!value.is_number_float()) return value.is_string() ? value.get<std::string>() : value.dump();
  std::ostringstream text;
  text << std::setprecision(4) << value.get<double>();
  return text.str();
}

/// Prints the first seven columns, which all rows of a task have.
void printTable(const Rows& rows) {
  constexpr std::size_t kColumns = 7;
  constexpr int kWidth = 20;
  if (rows.empty()) return;
  std::size_t column = 0;
  for (const auto& item : rows.front().items()) {
    if (column++ < kColumns) std::cout << std::left << std::setw(kWidth) << item.key();
  }
  std::cout << '\n';
  for (const Row& row : rows) {
    column = 0;
    for (const auto& item : row.items()) {
      if (column++ < kColumns) std::cout << std::left << std::setw(kWidth) << textOf(item.value());
    }
    std::cout << '\n';
  }
}

/// Changes "rays.json" to "rays-300k.json" in Google Benchmark's output option.
std::string forScene(const std::string& option, const std::string& scene) {
  const std::string name = "--benchmark_out=", ending = ".json";
  if (!option.starts_with(name) || !option.ends_with(ending)) return option;
  return option.substr(0, option.size() - ending.size()) + '-' + scene + ending;
}

}  // namespace

SessionOptions sessionOptions(int argc, char** argv, bool pinned) {
  SessionOptions options;
  options.core = pinned ? static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)) - 1 : -1;
  options.of_google = {argv[0]};
  for (int k = 1; k < argc; ++k) {
    const std::string argument = argv[k];
    if (argument == "--quick") {
      options.quick = true;
      continue;
    }
    if (argument != "--rows" && argument != "--scenes" && argument != "--core" && argument != "--poses") {
      options.of_google.push_back(argument);
      continue;
    }
    if (++k == argc) refuse(argument + " needs a value");
    if (argument == "--rows") options.rows_file = argv[k];
    if (argument == "--scenes") options.scenes = partsOf(argv[k]);
    if (argument == "--core") options.core = static_cast<int>(numberIn(argument, argv[k]));
    if (argument == "--poses")
      options.poses = static_cast<std::size_t>(std::max(0l, numberIn(argument, argv[k])));
  }
  return options;
}

int forEachScene(const SessionOptions& options, const std::vector<std::string>& scenes,
                 const std::function<void(const std::string&)>& run) {
  for (const std::string& wanted : options.scenes) {
    if (std::ranges::find(scenes, wanted) != scenes.end()) continue;
    std::string known;
    for (const std::string& scene : scenes) known += ' ' + scene;
    refuse("unknown scene '" + wanted + "'. Scenes of this program:" + known);
  }
  int exit_code = 0;
  for (const std::string& scene : scenes) {
    const auto& wanted = options.scenes;
    if (!wanted.empty() && std::ranges::find(wanted, scene) == wanted.end()) continue;
    std::cout.flush();
    const pid_t child = fork();
    if (child < 0) refuse("cannot start a process for scene " + scene);
    if (child == 0) {
      try {
        run(scene);
        std::cout.flush();
        std::fflush(nullptr);
        std::_Exit(0);  // skip the libraries' exit handlers
      } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        std::_Exit(2);
      }
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) continue;
    exit_code = 1;
    std::cerr << options.of_google[0] << ": scene " << scene << " failed"
              << (WIFSIGNALED(status) ? std::string(" by signal ") + std::to_string(WTERMSIG(status))
                                      : std::string())
              << "; it wrote no rows\n";
  }
  return exit_code;
}

// The user's options come later and override the defaults.
Session::Session(const SessionOptions& options, const std::string& scene)
    : rows_file_(options.rows_file),
      arguments_{options.of_google[0],
                 options.quick ? "--benchmark_repetitions=1" : "--benchmark_repetitions=5",
                 "--benchmark_enable_random_interleaving=true", "--benchmark_display_aggregates_only=true"} {
  for (std::size_t k = 1; k < options.of_google.size(); ++k)
    arguments_.push_back(forScene(options.of_google[k], scene));
  std::vector<char*> pointers;
  for (std::string& argument : arguments_) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) std::exit(2);
  if (options.core >= 0) pinTo(options.core);
  benchmark::AddCustomContext("processor", processorName());
  benchmark::AddCustomContext("pinned_to_core", options.core < 0 ? "none" : std::to_string(options.core));
  benchmark::AddCustomContext("octoblisk_flags", OCTOBLISK_BENCH_FLAGS);
  benchmark::AddCustomContext("peers", "from Debian's packages, as built by Debian");
  for (const auto& [name, about] : descriptions()) benchmark::AddCustomContext("contender " + name, about);
}

void Session::run() const {
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}

void Session::finish(const Rows& rows) const {
  printTable(rows);
  if (!rows_file_.empty()) addRows(rows_file_, rows);
}

}  // namespace octoblisk::bench
