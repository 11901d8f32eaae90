#include "base/file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

namespace octoblisk::detail {
namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& file, int error) {
  throw std::system_error(error, std::generic_category(), std::string(what) + ' ' + file.string());
}

/// An open file, which is closed by the destructor.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  int close() { return ::close(std::exchange(number_, -1)); }

 private:
  int number_;
};

/// Creates a new file beside another, and returns its name in `beside`.
int openBeside(const std::filesystem::path& file, std::filesystem::path& beside) {
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries; ++i) {
    beside = file;
    beside += ".new" + std::to_string(i);
    const int number = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (number >= 0 || errno != EEXIST) return number;
  }
  return -1;
}

bool writeAll(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& file) {
  const Descriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (opened.number() < 0) fail("cannot open", file, errno);
  struct stat status = {};
  if (::fstat(opened.number(), &status) != 0) fail("cannot read", file, errno);
  if (!S_ISREG(status.st_mode)) fail("cannot map", file, EINVAL);
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return;  // an empty file cannot be mapped
  void* const address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, opened.number(), 0);
  if (address == MAP_FAILED) fail("cannot map", file, errno);
  bytes_ = {static_cast<const std::byte*>(address), size};
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

void writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  std::filesystem::path beside;
  Descriptor opened(openBeside(file, beside));
  if (opened.number() < 0) fail("cannot create a file beside", file, errno);
  const bool is_written = writeAll(opened.number(), bytes) && ::fsync(opened.number()) == 0;
  int error = is_written ? 0 : errno;
  if (opened.close() != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(beside.c_str(), file.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(beside.c_str());
  fail("cannot write", file, error);
}

}  // namespace octoblisk::detail
