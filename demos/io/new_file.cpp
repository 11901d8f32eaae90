#include "io/new_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#ifdef _WIN32
#include <io.h>
#endif

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace octoblisk::demos {
namespace {

constexpr std::string_view kUnfinished = "unfinished-";

bool isUnfinished(const std::filesystem::path& file) {
  return file.filename().string().starts_with(kUnfinished);
}

#ifdef _WIN32
int fsync(int descriptor) { return ::_commit(descriptor); }
#endif

/// The open stream of this process that a name refers to: 1 or 2; 0: none. On Windows only "-" refers to one.
int streamOf(const std::filesystem::path& file) {
  if (file == "-") return STDOUT_FILENO;
#ifndef _WIN32
  struct stat named {
  }, opened{};
  if (::stat(file.c_str(), &named) != 0) return 0;
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    const bool is_it =
        ::fstat(stream, &opened) == 0 && opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
    if (is_it) return stream;
  }
#endif
  return 0;
}

std::FILE* openFor(const std::filesystem::path& file) {
  if (const int stream = streamOf(file); stream != 0) {
#ifdef _WIN32
    ::_setmode(stream, _O_BINARY);
#endif
    return ::fdopen(::dup(stream), "wb");
  }
  return std::fopen(file.string().c_str(), "wb");
}

}  // namespace

bool isDevice(const std::filesystem::path& file) {
  if (streamOf(file) != 0) return true;
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

bool isStandardOutput(const std::filesystem::path& file) { return streamOf(file) == STDOUT_FILENO; }

void requireNotRead(const std::string& out, const std::vector<std::filesystem::path>& files_read) {
  for (const std::filesystem::path& input : files_read) {
    std::error_code ignored;  // usually the file does not exist yet
    if (std::filesystem::equivalent(out, input, ignored)) {
      throw std::runtime_error(out + ": is also an input file: choose another --out");
    }
  }
}

std::filesystem::path behindLinks(const std::filesystem::path& file) {
  constexpr int kMaxLinks = 40;
  std::filesystem::path place = file;
  std::error_code error;
  for (int i = 0; i < kMaxLinks && std::filesystem::is_symlink(place, error); ++i) {
    const std::filesystem::path next = std::filesystem::read_symlink(place, error);
    if (error) break;
    place = next.is_absolute() ? next : place.parent_path() / next;
  }
  return place;
}

std::filesystem::path unfinishedName(const std::filesystem::path& file) {
  return file.parent_path() / (std::string(kUnfinished) + file.filename().string());
}

void refuseToWrite(const std::filesystem::path& file, int error) {
  std::filesystem::path target = file;
  if (isUnfinished(file)) {
    target = file.parent_path() / file.filename().string().substr(kUnfinished.size());
  }
  std::string message = target.string() + ": cannot be written";
  const std::filesystem::path folder = behindLinks(file).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    message += ": the folder " + folder.string() + " does not exist: create it";
  } else if (error != 0) {
    message += std::string(": ") + std::strerror(error);
  }
  throw std::runtime_error(message);
}

void requireOnDisk(const std::filesystem::path& file) {
#ifdef _WIN32
  const int opened = ::_wopen(file.c_str(), _O_RDWR | _O_NOINHERIT);
#else
  const int opened = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
#endif
  const bool is_on_disk = opened >= 0 && fsync(opened) == 0;
  const int error = errno;
  if (opened >= 0) ::close(opened);
  if (!is_on_disk) refuseToWrite(file, error);
}

NewFile::NewFile(std::filesystem::path file) : file_(std::move(file)), place_(file_), written_(file_) {
  if (std::filesystem::is_directory(file_)) {
    throw std::runtime_error(file_.string() + ": is a folder: give the name of a file");
  }
  if (!isDevice(file_) && !isUnfinished(file_)) {
    place_ = behindLinks(file_);
    written_ = unfinishedName(place_);
  }
  open_.reset(openFor(written_));
  if (!open_) refuseToWrite(file_, errno);
}

NewFile::~NewFile() {
  if (!open_ || written_ == file_) return;
  open_.reset();
  std::error_code ignored;
  std::filesystem::remove(written_, ignored);
}

void NewFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), open_.get()) != bytes.size()) refuseToWrite(file_, errno);
}

void NewFile::keep() {
  if (std::fflush(open_.get()) != 0) refuseToWrite(file_, errno);
  if (written_ != file_) {
    if (fsync(::fileno(open_.get())) != 0) refuseToWrite(file_, errno);
  }
  open_.reset();  // on Windows, an open file cannot be renamed
  if (written_ == file_) return;
  std::error_code error, ignored;
  std::filesystem::rename(written_, place_, error);
  if (!error) return;
  std::filesystem::remove(written_, ignored);
  refuseToWrite(file_, error.default_error_condition().value());
}

void writeFile(const std::filesystem::path& file, std::string_view bytes) {
  NewFile whole(file);
  whole.write(bytes);
  whole.keep();
}

}  // namespace octoblisk::demos
