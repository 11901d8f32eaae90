#include "session.h"

#include <benchmark/benchmark.h>
#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>

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

void pinTo(int core) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<std::size_t>(core), &cores);
  if (sched_setaffinity(0, sizeof cores, &cores) != 0) {
    refuse("cannot be pinned to core " + std::to_string(core) + ": give another by --core");
  }
}

std::string textOf(const Row& value) {
  if (!value.is_number_float()) return value.is_string() ? value.get<std::string>() : value.dump();
  std::ostringstream text;
  text << std::setprecision(4) << value.get<double>();
  return text.str();
}

/// The first seven columns, which all rows of a task have.
void printTable(const std::vector<Row>& rows) {
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

}  // namespace

Session::Session(int argc, char** argv, bool pinned)
    : core_(pinned ? static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)) - 1 : -1) {
  // Defaults that the user's own options, which come later, replace.
  std::vector<std::string> arguments = {argv[0], "--benchmark_min_time=0.05", "--benchmark_repetitions=7",
                                        "--benchmark_enable_random_interleaving=true",
                                        "--benchmark_display_aggregates_only=true"};
  for (int k = 1; k < argc; ++k) {
    const std::string argument = argv[k];
    if (argument != "--rows" && argument != "--core" && argument != "--poses") {
      arguments.push_back(argument);
      continue;
    }
    if (++k == argc) refuse(argument + " needs a value");
    if (argument == "--rows") rows_file_ = argv[k];
    if (argument == "--core") core_ = static_cast<int>(numberIn(argument, argv[k]));
    if (argument == "--poses") poses_ = static_cast<std::size_t>(std::max(0l, numberIn(argument, argv[k])));
  }
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) std::exit(2);
  if (core_ >= 0) pinTo(core_);
  benchmark::AddCustomContext("pinned_to_core", core_ < 0 ? "none" : std::to_string(core_));
  benchmark::AddCustomContext("octoblisk_flags", OCTOBLISK_BENCH_FLAGS);
  benchmark::AddCustomContext("peers", "the libraries of Debian's packages, as built there");
}

void Session::run() {
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}

int Session::finish(const std::vector<Row>& rows) const {
  printTable(rows);
  if (rows_file_.empty()) return 0;
  std::ofstream file(rows_file_);
  file << "[\n";
  for (std::size_t k = 0; k < rows.size(); ++k)
    file << rows[k].dump() << (k + 1 < rows.size() ? ",\n" : "\n");
  file << "]\n";
  file.close();
  if (!file) refuse(rows_file_ + " cannot be written");
  return 0;
}

}  // namespace octoblisk::bench
