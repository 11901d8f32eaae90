// Runs the octoblisk executable as its users do.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace octoblisk::demos {

inline std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string error;
};

/// Runs `octoblisk ARGUMENTS` in the folder.
inline Outcome runOctoblisk(const std::filesystem::path& folder, const std::string& arguments) {
  // Under the leak sanitizer, what the libraries keep to the end is no leak of ours.
  const std::string command = "cd '" + folder.string() +
                              "' && LSAN_OPTIONS='suppressions=" OCTOBLISK_LEAK_SUPPRESSIONS
                              ":print_suppressions=0' '" OCTOBLISK_COMMAND "' " +
                              arguments + " >stdout.txt 2>stderr.txt </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(folder / "stdout.txt"),
          contentOf(folder / "stderr.txt")};
}

}  // namespace octoblisk::demos
