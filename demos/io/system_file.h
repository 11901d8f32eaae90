// Files by the calls of the operating system: POSIX or Windows. Each function that fails sets errno.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace octoblisk::demos {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, FileCloser>;

/// Opens a file as std::fopen does. Returns an empty pointer on failure, as the next three functions do.
OpenFile openFile(const std::filesystem::path& file, const char* mode);

/// Opens standard output (1) or standard error (2) again, to write bytes.
OpenFile openStream(int stream);

/// Opens a nameless file, which vanishes when it is closed.
OpenFile openTemporary();

/// Opens or creates a file for reading and writing, and locks it until it is closed. `is_locked`: returns
/// whether another process has locked it. On file systems without locks, the lock is skipped.
OpenFile openLocked(const std::filesystem::path& file, bool& is_locked);

/// The open stream of this process that a name refers to: 1, 2, or 0 for none. On Windows, only "-" refers to
/// one, to 1.
int streamOf(const std::filesystem::path& file);

/// Writes what is buffered, and waits until the disk has it.
bool flushToDisk(std::FILE* file);

bool seekTo(std::FILE* file, std::uint64_t offset);
bool truncateTo(std::FILE* file, std::uint64_t size);

}  // namespace octoblisk::demos
