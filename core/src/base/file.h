// Files by the calls of the operating system: POSIX or Windows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>

namespace octoblisk::detail {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, FileCloser>;

// Each of these functions sets errno if it fails. Those that open a file then return an empty pointer.

/// Opens a file as std::fopen does.
OpenFile openFile(const std::filesystem::path& file, const char* mode);

/// Creates a file to write. Fails if the file exists.
OpenFile createFile(const std::filesystem::path& file);

/// Opens standard output (1) or standard error (2) again, to write bytes.
OpenFile openStream(int stream);

/// Opens or creates a file for reading and writing, and locks it until it is closed. `is_locked`: returns
/// whether another process has locked it. On file systems without locks, the lock is skipped.
OpenFile openLocked(const std::filesystem::path& file, bool& is_locked);

/// Writes what is buffered, and waits until the disk has it.
bool flushToDisk(std::FILE* file);

bool seekTo(std::FILE* file, std::uint64_t offset);
bool truncateTo(std::FILE* file, std::uint64_t size);

/// The open stream of this process that a name refers to: 1, 2, or 0 for none. On Windows, only "-" refers to
/// one, to 1.
int streamOf(const std::filesystem::path& file);

/// A file's bytes, mapped read-only while this object lives.
class MappedFile {
 public:
  /// Throws std::system_error (a std::runtime_error), which names the file.
  explicit MappedFile(const std::filesystem::path& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

/// Writes the whole file or leaves the old one: the bytes go to a new file in the same folder, which is then
/// renamed. Throws std::system_error, which names the file.
void writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes);

}  // namespace octoblisk::detail
