// Several files that appear together, complete, or not at all.
#pragma once

#include <filesystem>
#include <vector>

namespace octoblisk::demos {

/// Files are written under temporary names, and all get their own names together at the end. Until then, and
/// if the end is never reached, the files of an earlier run stay as they are.
class WholeFiles {
 public:
  WholeFiles() = default;
  ~WholeFiles();  ///< removes unfinished files
  WholeFiles(const WholeFiles&) = delete;
  WholeFiles& operator=(const WholeFiles&) = delete;

  /// Returns the name to write a file under: in the folder where links lead, with the same extension; a
  /// device keeps its name. Throws std::runtime_error naming a file that is a folder, or that has no folder.
  std::filesystem::path add(const std::filesystem::path& file);

  /// Gives all files their names once all are on the disk. Throws std::runtime_error naming a file that
  /// cannot be written, and the cause.
  void finish();

 private:
  std::vector<std::filesystem::path> files_;
};

}  // namespace octoblisk::demos
