#include "io/system_file.h"

#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
#include <fcntl.h>
#include <io.h>
#include <windows.h>
#undef far
#undef near
#else
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace octoblisk::demos {

#ifdef _WIN32

namespace {

/// Sets errno to the last error of Windows.
OpenFile failed() {
  const std::error_code error(static_cast<int>(::GetLastError()), std::system_category());
  errno = error.default_error_condition().value();
  return {};
}

OpenFile opened(HANDLE handle) {
  if (handle == INVALID_HANDLE_VALUE) return failed();
  const int descriptor = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_RDWR | _O_BINARY);
  return OpenFile(descriptor < 0 ? nullptr : ::_fdopen(descriptor, "r+b"));
}

}  // namespace

OpenFile openFile(const std::filesystem::path& file, const char* mode) {
  return OpenFile(::_wfopen(file.c_str(), std::filesystem::path(mode).c_str()));
}

OpenFile openStream(int stream) {
  ::_setmode(stream, _O_BINARY);
  return OpenFile(::_fdopen(::_dup(stream), "wb"));
}

OpenFile openTemporary() {
  std::array<wchar_t, MAX_PATH + 1> folder = {}, file = {};
  if (::GetTempPathW(folder.size(), folder.data()) == 0) return failed();
  if (::GetTempFileNameW(folder.data(), L"oct", 0, file.data()) == 0) return failed();
  return opened(::CreateFileW(file.data(), GENERIC_READ | GENERIC_WRITE, 0, nullptr, CREATE_ALWAYS,
                              FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, nullptr));
}

OpenFile openLocked(const std::filesystem::path& file, bool& is_locked) {
  const HANDLE handle =
      ::CreateFileW(file.c_str(), GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_DELETE, nullptr,
                    OPEN_ALWAYS, FILE_ATTRIBUTE_NORMAL, nullptr);
  is_locked = handle == INVALID_HANDLE_VALUE && ::GetLastError() == ERROR_SHARING_VIOLATION;
  return opened(handle);
}

int streamOf(const std::filesystem::path& file) { return file == "-" ? 1 : 0; }

bool flushToDisk(std::FILE* file) { return std::fflush(file) == 0 && ::_commit(::_fileno(file)) == 0; }

bool seekTo(std::FILE* file, std::uint64_t offset) {
  return ::_fseeki64(file, static_cast<std::int64_t>(offset), SEEK_SET) == 0;
}

bool truncateTo(std::FILE* file, std::uint64_t size) {
  errno = ::_chsize_s(::_fileno(file), static_cast<std::int64_t>(size));
  return errno == 0;
}

#else

namespace {

/// True if the name still refers to the open file.
bool isStillNamed(const std::filesystem::path& name, std::FILE* file) {
  struct stat opened = {}, named = {};
  return ::fstat(::fileno(file), &opened) == 0 && ::stat(name.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

OpenFile openFile(const std::filesystem::path& file, const char* mode) {
  return OpenFile(std::fopen(file.c_str(), mode));
}

OpenFile openStream(int stream) { return OpenFile(::fdopen(::dup(stream), "wb")); }

OpenFile openTemporary() { return OpenFile(std::tmpfile()); }

OpenFile openLocked(const std::filesystem::path& file, bool& is_locked) {
  is_locked = false;
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  OpenFile opened(descriptor < 0 ? nullptr : ::fdopen(descriptor, "r+b"));
  if (!opened) return opened;
  is_locked = (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) ||
              !isStillNamed(file, opened.get());
  return is_locked ? OpenFile() : std::move(opened);
}

int streamOf(const std::filesystem::path& file) {
  if (file == "-") return STDOUT_FILENO;
  struct stat named {
  }, opened{};
  if (::stat(file.c_str(), &named) != 0) return 0;
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    const bool is_it =
        ::fstat(stream, &opened) == 0 && opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
    if (is_it) return stream;
  }
  return 0;
}

bool flushToDisk(std::FILE* file) { return std::fflush(file) == 0 && ::fsync(::fileno(file)) == 0; }

bool seekTo(std::FILE* file, std::uint64_t offset) {
  return ::fseeko(file, static_cast<off_t>(offset), SEEK_SET) == 0;
}

bool truncateTo(std::FILE* file, std::uint64_t size) {
  return ::ftruncate(::fileno(file), static_cast<off_t>(size)) == 0;
}

#endif

}  // namespace octoblisk::demos
