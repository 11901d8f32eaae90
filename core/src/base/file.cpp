#include "base/file.h"

#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#include <windows.h>
#else
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace octoblisk::detail {
namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& file, std::error_code error) {
  throw std::system_error(error, std::string(what) + ' ' + file.string());
}

std::error_code lastError() { return {errno, std::generic_category()}; }

#ifdef _WIN32

[[noreturn]] void failToRead(const char* what, const std::filesystem::path& file) {
  fail(what, file, {static_cast<int>(::GetLastError()), std::system_category()});
}

/// Closed by the destructor.
class Handle {
 public:
  explicit Handle(HANDLE handle) : handle_(handle) {}
  ~Handle() {
    if (isOpen()) ::CloseHandle(handle_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  bool isOpen() const { return handle_ != nullptr && handle_ != INVALID_HANDLE_VALUE; }
  HANDLE get() const { return handle_; }

 private:
  HANDLE handle_;
};

/// Empty for an empty file, which cannot be mapped.
std::span<const std::byte> mapped(const std::filesystem::path& file) {
  const Handle opened(::CreateFileW(file.c_str(), GENERIC_READ,
                                    FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                                    OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr));
  if (!opened.isOpen()) failToRead("cannot open", file);
  LARGE_INTEGER size;
  if (!::GetFileSizeEx(opened.get(), &size)) failToRead("cannot read", file);
  if (size.QuadPart == 0) return {};
  const Handle mapping(::CreateFileMappingW(opened.get(), nullptr, PAGE_READONLY, 0, 0, nullptr));
  if (!mapping.isOpen()) failToRead("cannot map", file);
  const void* const address = ::MapViewOfFile(mapping.get(), FILE_MAP_READ, 0, 0, 0);
  if (address == nullptr) failToRead("cannot map", file);
  return {static_cast<const std::byte*>(address), static_cast<std::size_t>(size.QuadPart)};
}

void unmap(std::span<const std::byte> bytes) { ::UnmapViewOfFile(bytes.data()); }

int createNew(const std::filesystem::path& file) {
  return ::_wopen(file.c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT,
                  _S_IREAD | _S_IWRITE);
}

std::ptrdiff_t writeSome(int descriptor, std::span<const std::byte> bytes) {
  return ::_write(descriptor, bytes.data(),
                  static_cast<unsigned>(std::min<std::size_t>(bytes.size(), 1u << 30)));
}

bool isFlushed(int descriptor) { return ::_commit(descriptor) == 0; }

bool isClosed(int descriptor) { return ::_close(descriptor) == 0; }

#else

/// Empty for an empty file, which cannot be mapped.
std::span<const std::byte> mapped(const std::filesystem::path& file) {
  const int opened = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) fail("cannot open", file, lastError());
  struct stat status = {};
  const char* failed = nullptr;
  void* address = nullptr;
  if (::fstat(opened, &status) != 0) {
    failed = "cannot read";
  } else if (!S_ISREG(status.st_mode)) {
    failed = "cannot map";
    errno = EINVAL;
  } else if (status.st_size > 0) {
    address = ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE, opened, 0);
    if (address == MAP_FAILED) failed = "cannot map";
  }
  const std::error_code error = lastError();
  ::close(opened);
  if (failed != nullptr) fail(failed, file, error);
  return {static_cast<const std::byte*>(address), static_cast<std::size_t>(status.st_size)};
}

void unmap(std::span<const std::byte> bytes) { ::munmap(const_cast<std::byte*>(bytes.data()), bytes.size()); }

int createNew(const std::filesystem::path& file) {
  return ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

std::ptrdiff_t writeSome(int descriptor, std::span<const std::byte> bytes) {
  return ::write(descriptor, bytes.data(), bytes.size());
}

bool isFlushed(int descriptor) { return ::fsync(descriptor) == 0; }

bool isClosed(int descriptor) { return ::close(descriptor) == 0; }

#endif

/// Creates a new file beside another, and returns its name in `beside`.
int openBeside(const std::filesystem::path& file, std::filesystem::path& beside) {
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries; ++i) {
    beside = file;
    beside += ".new" + std::to_string(i);
    const int number = createNew(beside);
    if (number >= 0 || errno != EEXIST) return number;
  }
  return -1;
}

bool writeAll(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const std::ptrdiff_t written = writeSome(descriptor, bytes);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& file) : bytes_(mapped(file)) {}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) unmap(bytes_);
}

void writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  std::filesystem::path beside;
  const int descriptor = openBeside(file, beside);
  if (descriptor < 0) fail("cannot create a file beside", file, lastError());
  const bool is_written = writeAll(descriptor, bytes) && isFlushed(descriptor);
  std::error_code error = is_written ? std::error_code() : lastError();
  if (!isClosed(descriptor) && !error) error = lastError();
  if (!error) std::filesystem::rename(beside, file, error);
  if (!error) return;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  fail("cannot write", file, error);
}

}  // namespace octoblisk::detail
