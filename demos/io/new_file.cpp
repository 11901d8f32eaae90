#include "io/new_file.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr std::string_view kUnfinished = "unfinished-";

bool isUnfinished(const std::filesystem::path& file) {
  return file.filename().string().starts_with(kUnfinished);
}

OpenFile openToWrite(const std::filesystem::path& file) {
  const int stream = streamOf(file);
  return stream != 0 ? openStream(stream) : openFile(file, "wb");
}

}  // namespace

bool isDevice(const std::filesystem::path& file) {
  if (streamOf(file) != 0) return true;
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

bool isStandardOutput(const std::filesystem::path& file) { return streamOf(file) == 1; }

void requireNotRead(const std::string& out, const std::vector<std::filesystem::path>& files_read) {
  for (const std::filesystem::path& input : files_read) {
    std::error_code ignored;  // usually the file does not exist yet
    if (std::filesystem::equivalent(out, input, ignored)) {
      throw std::runtime_error(out + ": is also an input file: choose another output file");
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
  const OpenFile opened = openFile(file, "r+b");
  if (!opened || !flushToDisk(opened.get())) refuseToWrite(file, errno);
}

NewFile::NewFile(std::filesystem::path file) : file_(std::move(file)), place_(file_), written_(file_) {
  if (std::filesystem::is_directory(file_)) {
    throw std::runtime_error(file_.string() + ": is a folder: give the name of a file");
  }
  if (!isDevice(file_) && !isUnfinished(file_)) {
    place_ = behindLinks(file_);
    written_ = unfinishedName(place_);
  }
  open_ = openToWrite(written_);
  if (!open_) refuseToWrite(file_, errno);
}

NewFile::~NewFile() {
  open_.reset();  // Windows does not remove an open file
  std::error_code ignored;
  if (!kept_ && written_ != file_) std::filesystem::remove(written_, ignored);
}

void NewFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), open_.get()) != bytes.size()) refuseToWrite(file_, errno);
}

void NewFile::keep() {
  const bool is_whole = written_ == file_ ? std::fflush(open_.get()) == 0 : flushToDisk(open_.get());
  if (!is_whole) refuseToWrite(file_, errno);
  open_.reset();  // Windows does not rename an open file
  if (written_ != file_) {
    std::error_code error;
    std::filesystem::rename(written_, place_, error);
    if (error) refuseToWrite(file_, error.default_error_condition().value());
  }
  kept_ = true;
}

void writeFile(const std::filesystem::path& file, std::string_view bytes) {
  NewFile whole(file);
  whole.write(bytes);
  whole.keep();
}

}  // namespace octoblisk::demos
