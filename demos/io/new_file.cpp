#include "io/new_file.h"

#include <unistd.h>

#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace octoblisk::demos {

bool isDevice(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

void requireNotRead(const std::string& out, const std::vector<std::filesystem::path>& files_read) {
  for (const std::filesystem::path& input : files_read) {
    std::error_code ignored;  // there is no such file yet
    if (std::filesystem::equivalent(out, input, ignored)) {
      throw std::runtime_error(out + ": cannot be both read and written");
    }
  }
  if (out == "-") {
    throw std::runtime_error("-: the summary goes to standard output, the result to a file: name one");
  }
}

std::string cannotBeWritten(const std::filesystem::path& file) {
  const std::string refusal = "cannot be written";
  const std::filesystem::path folder = file.parent_path();
  if (folder.empty() || std::filesystem::is_directory(folder)) return refusal;
  return refusal + ", as there is no folder " + folder.string();
}

NewFile::NewFile(std::filesystem::path file) : file_(std::move(file)), written_(file_) {
  if (std::filesystem::is_directory(file_)) {
    throw std::runtime_error(file_.string() + ": this is a folder, not a file");
  }
  if (!isDevice(file_)) {
    if (std::filesystem::is_symlink(file_)) file_ = std::filesystem::weakly_canonical(file_);
    written_ = file_;
    written_ += ".new" + std::to_string(::getpid());
  }
  open_.reset(std::fopen(written_.c_str(), "wb"));
  if (!open_) throw std::runtime_error(file_.string() + ": " + cannotBeWritten(file_));
}

NewFile::~NewFile() {
  std::error_code ignored;
  if (open_ && written_ != file_) std::filesystem::remove(written_, ignored);
}

void NewFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), open_.get()) != bytes.size()) refuse();
}

void NewFile::keep() {
  if (std::fflush(open_.get()) != 0) refuse();
  if (written_ != file_) {
    std::error_code error;
    if (::fsync(::fileno(open_.get())) != 0) refuse();
    std::filesystem::rename(written_, file_, error);
    if (error) refuse();
  }
  open_.reset();
}

void NewFile::refuse() const { throw std::runtime_error(file_.string() + ": cannot be written to its end"); }

}  // namespace octoblisk::demos
