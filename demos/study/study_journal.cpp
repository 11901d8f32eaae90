#include "study/study_journal.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

namespace octoblisk::demos {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& message) {
  throw std::runtime_error(file.string() + ": " + message);
}

}  // namespace

StudyJournal::StudyJournal(Study study, ItemRange part, std::filesystem::path out, Form form, bool resume,
                           int rank)
    : study_(std::move(study)),
      out_(std::move(out)),
      form_(form),
      resume_(resume),
      named_(!isDevice(out_)),
      rank_(rank),
      head_(headOf(study_, part)),
      known_{study_, part, {}, 0} {
  if (std::filesystem::is_directory(out_)) refuse(out_, "is a folder: give the name of a file");
  if (!named_ && resume_) refuse(out_, "is a device, which --resume cannot continue");
  if (!named_) return;
  out_ = behindLinks(out_);
  bool is_locked = false;
  file_ = openLocked(unfinished(rank_), is_locked);
  if (is_locked) refuse(out_, "another run is writing it: wait for it, or choose another --out");
  if (!file_) refuseToWrite(out_, errno);
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  try {
    readAll();
  } catch (...) {
    file_.reset();
    std::error_code ignored;
    if (std::filesystem::file_size(unfinished(rank_), ignored) == 0) removeIfEmpty();
    throw;
  }
  finished_ = known_.groups.empty() && resume_ && form_ == Form::part && isDoneAlready();
}

StudyJournal::~StudyJournal() { removeIfEmpty(); }

void StudyJournal::removeIfEmpty() {
  std::error_code ignored;
  if (named_ && !has_own_groups_) std::filesystem::remove(unfinished(rank_), ignored);
}

/// Drops a truncated end; also drops a head without answers, which may belong to another study.
void StudyJournal::begin() {
  if (finished_) return;
  has_begun_ = true;
  if (!named_) {
    memory_ = head_;
    return;
  }
  if (!has_own_groups_) own_bytes_ = 0;
  bool is_ready = truncateTo(file_.get(), own_bytes_) && seekTo(file_.get(), own_bytes_);
  if (is_ready && own_bytes_ == 0) {
    own_bytes_ = head_.size();
    is_ready = std::fwrite(head_.data(), 1, head_.size(), file_.get()) == head_.size();
  }
  if (!is_ready) refuseToWrite(out_, errno);
}

/// The names of all journals that are there.
std::vector<std::filesystem::path> StudyJournal::journals() const {
  std::vector<std::filesystem::path> names = {unfinished()};
  const std::string begin = unfinished().filename().string() + '.';
  const std::filesystem::path folder = out_.has_parent_path() ? out_.parent_path() : ".";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_of_rank = name.starts_with(begin) && name.size() > begin.size() &&
                            name.find_first_not_of("0123456789", begin.size()) == std::string::npos;
    if (is_of_rank) names.push_back(out_.parent_path() / name);
  }
  return names;
}

/// The journals with answers; notes what is known.
std::vector<PartFile> StudyJournal::readAll() {
  std::vector<PartFile> found;
  known_.groups.clear();
  for (const std::filesystem::path& name : journals()) {
    if (!std::filesystem::exists(name)) continue;
    try {
      PartFile file(name);
      if (file.text().size() < head_.size() && head_.starts_with(file.text())) continue;  // ended in the head
      file.part = readPart(file.text());
      if (file.part.groups.empty()) continue;
      requireContinued(file);
      if (name == unfinished(rank_)) {
        has_own_groups_ = true;
        own_bytes_ = file.part.sound_bytes;
      }
      known_.groups.insert(known_.groups.end(), file.part.groups.begin(), file.part.groups.end());
      found.push_back(std::move(file));
    } catch (const std::invalid_argument& error) {
      refuse(name, error.what());
    }
  }
  return found;
}

/// Throws std::invalid_argument unless the journal belongs to this run, or to the run that it continues.
void StudyJournal::requireContinued(const PartFile& found) const {
  const PartText& part = found.part;
  if (!resume_ && !has_begun_) {
    throw std::invalid_argument(
        "has the answers of an unfinished run: continue it with --resume, or remove the file");
  }
  const std::string difference = differenceOf(study_, part.study);
  if (!difference.empty())
    throw std::invalid_argument("belongs to a run with other " + difference +
                                ": remove the file to start anew");
  if (part.items != known_.items) {
    throw std::invalid_argument("belongs to another part: items " + std::to_string(part.items.begin) +
                                " to " + std::to_string(part.items.end));
  }
  if (!found.text().starts_with(head_))
    throw std::invalid_argument("is damaged: its head has changed: remove the file to start anew");
}

/// True if OUT is already this part, complete: then it stays.
bool StudyJournal::isDoneAlready() try {
  PartFile file(out_);
  file.part = readPart(file.text());
  const bool is_done = differenceOf(study_, file.part.study).empty() && file.part.items == known_.items &&
                       missingItems(file.part).empty();
  if (is_done) known_ = std::move(file.part);
  return is_done;
} catch (const std::exception&) {  // OUT does not exist, or is another result
  return false;
}

std::size_t StudyJournal::answered() const {
  std::size_t count = 0;
  for (const GroupInText& group : known_.groups) count += group.items.size();
  return count;
}

void StudyJournal::add(std::span<const AnsweredGroup> groups) {
  std::string text;
  for (const AnsweredGroup& group : groups) {
    text += textOf(group, head_);
    known_.groups.push_back({group.items, 0, 0, group.tally});
  }
  has_own_groups_ = true;
  if (!named_) {
    memory_ += text;
    return;
  }
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) {
    refuse(out_, std::string("cannot be written: ") + std::strerror(errno) + "; the answers so far are in " +
                     unfinished().string());
  }
}

std::vector<std::string> StudyJournal::finish() {
  std::vector<std::string> tallies;
  if (finished_) {
    for (const GroupInText& group : known_.groups) tallies.push_back(group.tally);
    return tallies;
  }
  std::vector<PartFile> files;
  if (named_) {
    files = readAll();
  } else {
    PartFile& own = files.emplace_back(out_, std::move(memory_));
    own.part = readPart(own.text());
  }
  NewFile whole(out_);
  whole.write(form_ == Form::part ? head_ : study_.columns + '\n');
  tallies = writeInOrder(files, form_ == Form::part ? head_ : std::string(), whole);
  whole.keep();
  files.clear();  // Windows does not remove a mapped file
  std::error_code ignored;
  if (!named_) return tallies;
  for (const std::filesystem::path& name : journals()) std::filesystem::remove(name, ignored);
  file_.reset();
  return tallies;
}

std::filesystem::path StudyJournal::unfinished(int rank) const {
  std::filesystem::path name = out_;
  name += rank == 0 ? ".partial" : ".partial." + std::to_string(rank);
  return name;
}

}  // namespace octoblisk::demos
