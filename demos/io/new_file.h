// A file that is there whole or not at all.
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

/// Whether there is something of this name that is no file on a disk, e.g. a pipe: it can be written to, but
/// not be replaced.
bool isDevice(const std::filesystem::path& file);

/// Throws std::runtime_error naming the file where it is one of those read, or "-".
void requireNotRead(const std::string& out, const std::vector<std::filesystem::path>& files_read);

/// "cannot be written", and why not where its folder is missing.
std::string cannotBeWritten(const std::filesystem::path& file);

/// Writes to a new file in the same folder, which takes the name when all is written; to a device directly.
class NewFile {
 public:
  /// Throws std::runtime_error naming the file where it is a folder or cannot be written.
  explicit NewFile(std::filesystem::path file);
  /// Leaves what was there, unless it has been kept.
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// These throw std::runtime_error naming the file.
  void write(std::string_view bytes);
  void keep();

 private:
  [[noreturn]] void refuse() const;

  std::filesystem::path file_, written_;
  OpenFile open_;
};

}  // namespace octoblisk::demos
