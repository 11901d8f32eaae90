// Writes files atomically and maps files to memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace octoblisk::detail {

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
