// Runs the octoblisk executable as users do.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <compare>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>

namespace octoblisk::demos {

inline std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A number that prints the command's messages if it is not the expected one.
struct ExitCode {
  int value = -1;
  std::string error;  ///< what the command wrote to standard error

  bool operator==(const ExitCode& other) const { return value == other.value; }
  bool operator==(int other) const { return value == other; }
  std::strong_ordering operator<=>(int other) const { return value <=> other; }
  friend std::ostream& operator<<(std::ostream& stream, const ExitCode& code) {
    stream << code.value;
    return code.error.empty() ? stream : stream << ", with the message: " << code.error;
  }
};

struct Outcome {
  ExitCode exit_code;
  std::string out;
  std::string error;
};

/// The outcome of a command that std::system ran and whose output is in the folder.
inline Outcome outcomeOf(int status, const std::filesystem::path& folder) {
  const std::string error = contentOf(folder / "stderr.txt");
  return {{WIFEXITED(status) ? WEXITSTATUS(status) : -1, error}, contentOf(folder / "stdout.txt"), error};
}

inline std::string octobliskIn(const std::filesystem::path& folder, const std::string& arguments) {
  // Memory that the libraries keep until the end is not a leak of this project.
  return "cd '" + folder.string() +
         "' && export LSAN_OPTIONS='suppressions=" OCTOBLISK_LEAK_SUPPRESSIONS
         ":print_suppressions=0' && exec '" OCTOBLISK_COMMAND "' " +
         arguments + " >stdout.txt 2>stderr.txt </dev/null";
}

/// Runs `octoblisk ARGUMENTS` in the folder.
inline Outcome runOctoblisk(const std::filesystem::path& folder, const std::string& arguments) {
  return outcomeOf(std::system(octobliskIn(folder, arguments).c_str()), folder);
}

/// Starts it and does not wait for it. It reacts to Ctrl-C, even if the tests ignore it.
inline pid_t startOctoblisk(const std::filesystem::path& folder, const std::string& arguments) {
  const std::string command = octobliskIn(folder, arguments);
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGINT, SIG_DFL);
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  return child;
}

}  // namespace octoblisk::demos
