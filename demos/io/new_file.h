// A file that is written completely or not at all. The command writes every file this way.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/file.h"

namespace octoblisk::demos {

using detail::OpenFile;

/// True if the name refers to something that can be written to but not replaced: a device or a pipe, this
/// process's standard output or error, or "-", which means standard output.
bool isDevice(const std::filesystem::path& file);

/// True if the name refers to standard output: "-", or a path of it.
bool isStandardOutput(const std::filesystem::path& file);

/// Throws std::runtime_error naming the file if it is also an input file.
void requireNotRead(const std::string& out, const std::vector<std::filesystem::path>& files_read);

/// The file that a symbolic link leads to. Returns the argument itself if it is not a link.
std::filesystem::path behindLinks(const std::filesystem::path& file);

/// The temporary name of an unfinished file: in the same folder, with the same extension.
std::filesystem::path unfinishedName(const std::filesystem::path& file);

/// Throws std::runtime_error: "FILE: cannot be written: No space left on device". `error` is an errno value,
/// or 0 if the cause is unknown. The message names the final file, not its unfinished name.
[[noreturn]] void refuseToWrite(const std::filesystem::path& file, int error);

/// Flushes a written file to its disk. Throws as refuseToWrite does.
void requireOnDisk(const std::filesystem::path& file);

/// Writes to a new file in the same folder and renames it when it is complete and on the disk. Follows
/// symbolic links. Writes directly to devices and to files that already have an unfinished name.
class NewFile {
 public:
  /// Throws std::runtime_error naming the file and the cause, for instance if it is a folder.
  explicit NewFile(std::filesystem::path file);
  /// Leaves the old file in place unless keep() was called.
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// These throw std::runtime_error naming the file and the cause.
  void write(std::string_view bytes);
  void keep();

 private:
  std::filesystem::path file_, place_, written_;
  OpenFile open_;
  bool kept_ = false;
};

/// Writes a whole file this way. Throws std::runtime_error naming the file and the cause.
void writeFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace octoblisk::demos
