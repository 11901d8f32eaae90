// Files that are there whole, or not at all.
#pragma once

#include <filesystem>
#include <vector>

namespace octoblisk::demos {

/// Files are written under other names, and get their own together at the end: until then, and where it does
/// not come to that, those of an earlier run stay as they are.
class WholeFiles {
 public:
  WholeFiles() = default;
  ~WholeFiles();  ///< removes what was not finished
  WholeFiles(const WholeFiles&) = delete;
  WholeFiles& operator=(const WholeFiles&) = delete;

  /// The name to write a file under: beside it, where links lead, and with its extension; a device's own.
  /// Throws std::runtime_error naming a file that is a folder, or in none.
  std::filesystem::path add(const std::filesystem::path& file);

  /// Gives all files their names, once all are on the disk. Throws std::runtime_error naming a file that
  /// cannot be written, and the cause.
  void finish();

 private:
  std::vector<std::filesystem::path> files_;
};

}  // namespace octoblisk::demos
