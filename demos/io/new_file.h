// A file that is there whole or not at all: the one way in which the command writes files.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace octoblisk::demos {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, FileCloser>;

/// Whether there is something of this name that is no file on a disk, e.g. a pipe, or that is this process'
/// standard output or error, or "-", which means standard output: it can be written to, but not be replaced.
bool isDevice(const std::filesystem::path& file);

/// Whether it is standard output, by "-" or a name of it.
bool isStandardOutput(const std::filesystem::path& file);

/// Throws std::runtime_error naming the file where it is one of those read, or "-".
void requireNotRead(const std::string& out, const std::vector<std::filesystem::path>& files_read);

/// Where links lead to; the file itself where it is none, or there is nothing yet.
std::filesystem::path behindLinks(const std::filesystem::path& file);

/// The name that a file has until it is finished: beside it, and with its extension.
std::filesystem::path unfinishedName(const std::filesystem::path& file);

/// "FILE: cannot be written: No space left on device". `error`: of errno, 0 where there is none. A file under
/// its unfinished name is told by its own.
[[noreturn]] void refuseToWrite(const std::filesystem::path& file, int error);

/// Makes sure that what was written to a file is on its disk. Throws as refuseToWrite.
void requireOnDisk(const std::filesystem::path& file);

/// Writes to a new file in the same folder, which takes the name when all is written and on the disk; through
/// links; to a device directly, and so to a file under its unfinished name.
class NewFile {
 public:
  /// Throws std::runtime_error naming the file, where it is a folder, or with the cause.
  explicit NewFile(std::filesystem::path file);
  /// Leaves what was there, unless it has been kept.
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// These throw std::runtime_error naming the file and the cause.
  void write(std::string_view bytes);
  void keep();

 private:
  std::filesystem::path file_, place_, written_;
  OpenFile open_;
};

/// Writes a whole file so. Throws std::runtime_error naming the file and the cause.
void writeFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace octoblisk::demos
