#include "io/whole_files.h"

#include <stdexcept>
#include <system_error>

#include "io/new_file.h"

namespace octoblisk::demos {

WholeFiles::~WholeFiles() {
  for (const std::filesystem::path& file : files_) {
    std::error_code ignored;
    std::filesystem::remove(unfinishedName(behindLinks(file)), ignored);
  }
}

std::filesystem::path WholeFiles::add(const std::filesystem::path& file) {
  if (isDevice(file)) return file;
  const std::filesystem::path place = behindLinks(file);
  const std::filesystem::path folder = place.has_parent_path() ? place.parent_path() : ".";
  if (std::filesystem::is_directory(file)) {
    throw std::runtime_error(file.string() + ": is a folder: give the name of a file");
  }
  if (!std::filesystem::is_directory(folder)) refuseToWrite(file, 0);
  files_.push_back(file);
  return unfinishedName(place);
}

void WholeFiles::finish() {
  for (const std::filesystem::path& file : files_) requireOnDisk(unfinishedName(behindLinks(file)));
  while (!files_.empty()) {
    const std::filesystem::path place = behindLinks(files_.back());
    std::error_code error;
    std::filesystem::rename(unfinishedName(place), place, error);
    if (error) refuseToWrite(files_.back(), error.value());
    files_.pop_back();
  }
}

}  // namespace octoblisk::demos
