#include "io/whole_files.h"

#include <stdexcept>
#include <system_error>

#include "io/new_file.h"

namespace octoblisk::demos {
namespace {

std::filesystem::path unfinished(const std::filesystem::path& file) {
  return file.parent_path() / ("unfinished-" + file.filename().string());
}

}  // namespace

WholeFiles::~WholeFiles() {
  for (const std::filesystem::path& file : files_) {
    std::error_code ignored;
    std::filesystem::remove(unfinished(file), ignored);
  }
}

std::filesystem::path WholeFiles::add(const std::filesystem::path& file) {
  if (isDevice(file)) return file;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (std::filesystem::is_directory(file) || !std::filesystem::is_directory(folder)) {
    throw std::runtime_error(file.string() + ": cannot be written");
  }
  files_.push_back(file);
  return unfinished(file);
}

void WholeFiles::finish() {
  while (!files_.empty()) {
    std::error_code error;
    std::filesystem::rename(unfinished(files_.back()), files_.back(), error);
    if (error) {
      throw std::runtime_error(files_.back().string() + ": cannot be written: " + error.message());
    }
    files_.pop_back();
  }
}

}  // namespace octoblisk::demos
