// The folder that a subcommand writes to.
#pragma once

#include <filesystem>
#include <stdexcept>

namespace octoblisk::demos {

/// Creates the folder if it is missing. Throws std::runtime_error naming it.
inline void makeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error(folder.string() + ": cannot create the folder: " + error.message() +
                             ": choose another --out");
}

}  // namespace octoblisk::demos
