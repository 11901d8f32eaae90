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
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace octoblisk::detail {
namespace {

// The calls of the operating system. Those that fail set errno.
#ifdef _WIN32

using Status = struct _stat64;

int openToRead(const std::filesystem::path& file) {
  return ::_wopen(file.c_str(), _O_RDONLY | _O_BINARY | _O_NOINHERIT);
}

int createNew(const std::filesystem::path& file) {
  return ::_wopen(file.c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT,
                  _S_IREAD | _S_IWRITE);
}

int readStatus(int descriptor, Status& status) { return ::_fstat64(descriptor, &status); }

std::ptrdiff_t writeSome(int descriptor, std::span<const std::byte> bytes) {
  constexpr std::size_t kMax = 1u << 30;
  return ::_write(descriptor, bytes.data(), static_cast<unsigned>(std::min(bytes.size(), kMax)));
}

int flush(int descriptor) { return ::_commit(descriptor); }

int closeDescriptor(int descriptor) { return ::_close(descriptor); }

const void* mapped(int descriptor, std::size_t) {
  const auto file = reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor));
  const HANDLE mapping = ::CreateFileMappingW(file, nullptr, PAGE_READONLY, 0, 0, nullptr);
  const void* const address = mapping == nullptr ? nullptr : ::MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, 0);
  const std::error_code error(static_cast<int>(::GetLastError()), std::system_category());
  if (mapping != nullptr) ::CloseHandle(mapping);  // the address keeps the file mapped
  if (address == nullptr) errno = error.default_error_condition().value();
  return address;
}

void unmap(std::span<const std::byte> bytes) { ::UnmapViewOfFile(bytes.data()); }

#else

using Status = struct stat;

int openToRead(const std::filesystem::path& file) { return ::open(file.c_str(), O_RDONLY | O_CLOEXEC); }

int createNew(const std::filesystem::path& file) {
  return ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

int readStatus(int descriptor, Status& status) { return ::fstat(descriptor, &status); }

std::ptrdiff_t writeSome(int descriptor, std::span<const std::byte> bytes) {
  return ::write(descriptor, bytes.data(), bytes.size());
}

int flush(int descriptor) { return ::fsync(descriptor); }

int closeDescriptor(int descriptor) { return ::close(descriptor); }

const void* mapped(int descriptor, std::size_t size) {
  const void* const address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  return address == MAP_FAILED ? nullptr : address;
}

void unmap(std::span<const std::byte> bytes) { ::munmap(const_cast<std::byte*>(bytes.data()), bytes.size()); }

#endif

[[noreturn]] void fail(const char* what, const std::filesystem::path& file, std::error_code error) {
  throw std::system_error(error, std::string(what) + ' ' + file.string());
}

std::error_code lastError() { return {errno, std::generic_category()}; }

/// An open file, which is closed by the destructor.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) closeDescriptor(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  int close() { return closeDescriptor(std::exchange(number_, -1)); }

 private:
  int number_;
};

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

MappedFile::MappedFile(const std::filesystem::path& file) {
  const Descriptor opened(openToRead(file));
  if (opened.number() < 0) fail("cannot open", file, lastError());
  Status status = {};
  if (readStatus(opened.number(), status) != 0) fail("cannot read", file, lastError());
  if ((status.st_mode & S_IFMT) != S_IFREG) {
    fail("cannot map", file, std::make_error_code(std::errc::invalid_argument));
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return;  // an empty file cannot be mapped
  const void* const address = mapped(opened.number(), size);
  if (address == nullptr) fail("cannot map", file, lastError());
  bytes_ = {static_cast<const std::byte*>(address), size};
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) unmap(bytes_);
}

void writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  std::filesystem::path beside;
  Descriptor opened(openBeside(file, beside));
  if (opened.number() < 0) fail("cannot create a file beside", file, lastError());
  const bool is_written = writeAll(opened.number(), bytes) && flush(opened.number()) == 0;
  std::error_code error = is_written ? std::error_code() : lastError();
  if (opened.close() != 0 && !error) error = lastError();
  if (!error) std::filesystem::rename(beside, file, error);
  if (!error) return;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  fail("cannot write", file, error);
}

}  // namespace octoblisk::detail
