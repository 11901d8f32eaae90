#include "base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
#include <io.h>
#include <windows.h>
#undef far
#undef near
#else
#include <sys/file.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace octoblisk::detail {

#ifdef _WIN32

namespace {

/// Sets errno to the last error of Windows.
void setErrno() {
  const std::error_code error(static_cast<int>(::GetLastError()), std::system_category());
  errno = error.default_error_condition().value();
}

OpenFile opened(HANDLE handle) {
  if (handle == INVALID_HANDLE_VALUE) {
    setErrno();
    return {};
  }
  const int descriptor = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_RDWR | _O_BINARY);
  return OpenFile(descriptor < 0 ? nullptr : ::_fdopen(descriptor, "r+b"));
}

using Status = struct _stat64;

int readStatus(std::FILE* file, Status& status) { return ::_fstat64(::_fileno(file), &status); }

const void* mapped(std::FILE* file, std::size_t) {
  const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(::_fileno(file)));
  const HANDLE mapping = ::CreateFileMappingW(handle, nullptr, PAGE_READONLY, 0, 0, nullptr);
  const void* const address = mapping == nullptr ? nullptr : ::MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, 0);
  if (address == nullptr) setErrno();
  if (mapping != nullptr) ::CloseHandle(mapping);  // the address keeps the file mapped
  return address;
}

void unmap(std::span<const std::byte> bytes) { ::UnmapViewOfFile(bytes.data()); }

}  // namespace

OpenFile openFile(const std::filesystem::path& file, const char* mode) {
  return OpenFile(::_wfopen(file.c_str(), std::filesystem::path(mode).c_str()));
}

OpenFile createFile(const std::filesystem::path& file) {
  return opened(::CreateFileW(file.c_str(), GENERIC_READ | GENERIC_WRITE, 0, nullptr, CREATE_NEW,
                              FILE_ATTRIBUTE_NORMAL, nullptr));
}

OpenFile openStream(int stream) {
  ::_setmode(stream, _O_BINARY);
  return OpenFile(::_fdopen(::_dup(stream), "wb"));
}

OpenFile openLocked(const std::filesystem::path& file, bool& is_locked) {
  const HANDLE handle =
      ::CreateFileW(file.c_str(), GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_DELETE, nullptr,
                    OPEN_ALWAYS, FILE_ATTRIBUTE_NORMAL, nullptr);
  is_locked = handle == INVALID_HANDLE_VALUE && ::GetLastError() == ERROR_SHARING_VIOLATION;
  return opened(handle);
}

bool flushToDisk(std::FILE* file) { return std::fflush(file) == 0 && ::_commit(::_fileno(file)) == 0; }

bool seekTo(std::FILE* file, std::uint64_t offset) {
  return ::_fseeki64(file, static_cast<std::int64_t>(offset), SEEK_SET) == 0;
}

bool truncateTo(std::FILE* file, std::uint64_t size) {
  errno = ::_chsize_s(::_fileno(file), static_cast<std::int64_t>(size));
  return errno == 0;
}

int streamOf(const std::filesystem::path& file) { return file == "-" ? 1 : 0; }

#else

namespace {

using Status = struct stat;

int readStatus(std::FILE* file, Status& status) { return ::fstat(::fileno(file), &status); }

/// True if the name refers to the open file.
bool isNamed(const std::filesystem::path& name, int descriptor) {
  Status opened = {}, named = {};
  return ::fstat(descriptor, &opened) == 0 && ::stat(name.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

const void* mapped(std::FILE* file, std::size_t size) {
  const void* const address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, ::fileno(file), 0);
  return address == MAP_FAILED ? nullptr : address;
}

void unmap(std::span<const std::byte> bytes) { ::munmap(const_cast<std::byte*>(bytes.data()), bytes.size()); }

}  // namespace

OpenFile openFile(const std::filesystem::path& file, const char* mode) {
  return OpenFile(std::fopen(file.c_str(), mode));
}

OpenFile createFile(const std::filesystem::path& file) { return OpenFile(std::fopen(file.c_str(), "wbx")); }

OpenFile openStream(int stream) { return OpenFile(::fdopen(::dup(stream), "wb")); }

OpenFile openLocked(const std::filesystem::path& file, bool& is_locked) {
  is_locked = false;
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  OpenFile opened(descriptor < 0 ? nullptr : ::fdopen(descriptor, "r+b"));
  if (!opened) return opened;
  is_locked = (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) ||
              !isNamed(file, descriptor);  // another process has renamed it
  return is_locked ? OpenFile() : std::move(opened);
}

bool flushToDisk(std::FILE* file) { return std::fflush(file) == 0 && ::fsync(::fileno(file)) == 0; }

bool seekTo(std::FILE* file, std::uint64_t offset) {
  return ::fseeko(file, static_cast<off_t>(offset), SEEK_SET) == 0;
}

bool truncateTo(std::FILE* file, std::uint64_t size) {
  return ::ftruncate(::fileno(file), static_cast<off_t>(size)) == 0;
}

int streamOf(const std::filesystem::path& file) {
  if (file == "-") return STDOUT_FILENO;
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    if (isNamed(file, stream)) return stream;
  }
  return 0;
}

#endif

namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& file, std::error_code error) {
  throw std::system_error(error, std::string(what) + ' ' + file.string());
}

std::error_code lastError() { return {errno, std::generic_category()}; }

/// Creates a new file beside another, and returns its name in `beside`.
OpenFile createBeside(const std::filesystem::path& file, std::filesystem::path& beside) {
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries; ++i) {
    beside = file;
    beside += ".new" + std::to_string(i);
    OpenFile created = createFile(beside);
    if (created || errno != EEXIST) return created;
  }
  return {};
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& file) {
  const OpenFile opened = openFile(file, "rb");
  if (!opened) fail("cannot open", file, lastError());
  Status status = {};
  if (readStatus(opened.get(), status) != 0) fail("cannot read", file, lastError());
  if ((status.st_mode & S_IFMT) != S_IFREG) {
    fail("cannot map", file, std::make_error_code(std::errc::invalid_argument));
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return;  // an empty file cannot be mapped
  const void* const address = mapped(opened.get(), size);
  if (address == nullptr) fail("cannot map", file, lastError());
  bytes_ = {static_cast<const std::byte*>(address), size};
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) unmap(bytes_);
}

void writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  std::filesystem::path beside;
  OpenFile opened = createBeside(file, beside);
  if (!opened) fail("cannot create a file beside", file, lastError());
  const bool is_written =
      std::fwrite(bytes.data(), 1, bytes.size(), opened.get()) == bytes.size() && flushToDisk(opened.get());
  std::error_code error = is_written ? std::error_code() : lastError();
  if (std::fclose(opened.release()) != 0 && !error) error = lastError();
  if (!error) std::filesystem::rename(beside, file, error);
  if (!error) return;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  fail("cannot write", file, error);
}

}  // namespace octoblisk::detail
