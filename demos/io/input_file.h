// Opens a user's file for reading.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace octoblisk::demos {

/// Opens a file as bytes. Throws std::runtime_error naming the file and the cause: it does not exist, is a
/// folder, or cannot be opened.
inline std::ifstream openForReading(const std::filesystem::path& file) {
  const auto refuse = [&](const char* reason) { throw std::runtime_error(file.string() + ": " + reason); };
  std::error_code error;  // ignored: if the file cannot be examined, opening it reports the cause
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) refuse("no such file");
  if (std::filesystem::is_directory(status)) refuse("is a folder: give the name of a file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse("cannot be opened for reading");
  return stream;
}

}  // namespace octoblisk::demos
