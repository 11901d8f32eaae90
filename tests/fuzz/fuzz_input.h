// Shared by the fuzz targets of readers: writes the fuzzer's bytes to files and checks refusals.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace octoblisk::fuzz {

[[noreturn]] inline void fail(std::string_view what, std::string_view detail = {}) {
  std::fprintf(stderr, "%.*s: %.*s\n", static_cast<int>(what.size()), what.data(),
               static_cast<int>(detail.size()), detail.data());
  std::abort();
}

inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// This process's own folder. It is removed at exit unless the process crashes.
class ScratchFolder {
 public:
  ScratchFolder()
      : path_(std::filesystem::temp_directory_path() / ("octoblisk_fuzz_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, std::string_view content) const {
    std::ofstream(path_ / name, std::ios::binary)
        .write(content.data(), static_cast<std::streamsize>(content.size()));
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// The message on bad input must be one line without control characters that begins with the bad file or
/// folder.
inline void requireClear(const std::exception& refusal, const std::filesystem::path& file) {
  const std::string_view message = refusal.what();
  if (!message.starts_with(file.string())) fail("a refusal that names no file", message);
  const auto is_control = [](char letter) {
    return static_cast<unsigned char>(letter) < ' ' || letter == 0x7f;
  };
  if (std::ranges::any_of(message, is_control)) fail("a refusal of more than one line", message);
}

/// The fuzzer's bytes, split at lines that consist of `%`.
inline std::vector<std::string_view> pieces(std::string_view bytes) {
  constexpr std::string_view kCut = "\n%\n";
  std::vector<std::string_view> result;
  for (;;) {
    const std::size_t cut = bytes.find(kCut);
    result.push_back(bytes.substr(0, cut));
    if (cut == std::string_view::npos) return result;
    bytes.remove_prefix(cut + kCut.size());
  }
}

}  // namespace octoblisk::fuzz
