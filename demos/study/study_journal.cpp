#include "study/study_journal.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/file.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

std::string_view textIn(const MappedFile& file) {
  return {reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
}

}  // namespace

StudyJournal::StudyJournal(Study study, ItemRange part, std::filesystem::path out, Form form, bool resume)
    : study_(std::move(study)),
      out_(std::move(out)),
      form_(form),
      resume_(resume),
      named_(!isDevice(out_)),
      head_(headOf(study_, part)) {
  part_.study = study_;
  part_.items = part;
  if (std::filesystem::is_directory(out_)) refuse(out_, "is a folder: give the name of a file");
  if (named_) out_ = behindLinks(out_);
  if (!named_ && resume_) refuse(out_, "is a device, which --resume cannot continue");
  open();
  if (named_) readBack();
  if (part_.groups.empty() && resume_ && form_ == Form::part && isDoneAlready()) return;
  if (!goesToItsEnd()) {
    removeIfEmpty();
    refuseToWrite(out_, errno);
  }
}

StudyJournal::~StudyJournal() { removeIfEmpty(); }

/// Drops a truncated end; also drops a head without answers, which may belong to another study.
bool StudyJournal::goesToItsEnd() {
  if (part_.groups.empty()) part_.sound_bytes = 0;
  const std::uint64_t size = part_.sound_bytes;
  if (!truncateTo(file_.get(), size) || !seekTo(file_.get(), size)) return false;
  if (part_.sound_bytes > 0) return true;
  part_.sound_bytes = head_.size();
  return std::fwrite(head_.data(), 1, head_.size(), file_.get()) == head_.size();
}

void StudyJournal::removeIfEmpty() {
  std::error_code ignored;
  if (file_ && named_ && part_.groups.empty()) std::filesystem::remove(unfinished(), ignored);
}

void StudyJournal::open() {
  bool is_locked = false;
  file_ = named_ ? openLocked(unfinished(), is_locked) : openTemporary();
  if (is_locked) refuse(out_, "another run is writing it: wait for it, or choose another --out");
  if (!file_) refuseToWrite(out_, errno);
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
}

/// Finds the answers of an earlier run in the open file.
void StudyJournal::readBack() try {
  const MappedFile mapped(unfinished());
  const std::string_view text = textIn(mapped);
  if (text.size() < head_.size() && head_.starts_with(text)) return;  // the run ended while writing the head
  PartText found = readPart(text);
  if (found.groups.empty()) return;
  if (!resume_) {
    throw std::invalid_argument(
        "has the answers of an unfinished run: continue it with --resume, or remove the file");
  }
  const std::string difference = differenceOf(study_, found.study);
  if (!difference.empty())
    throw std::invalid_argument("belongs to a run with other " + difference +
                                ": remove the file to start anew");
  if (found.items != part_.items) {
    throw std::invalid_argument("belongs to another part: items " + std::to_string(found.items.begin) +
                                " to " + std::to_string(found.items.end));
  }
  if (!text.starts_with(head_))
    throw std::invalid_argument("is damaged: its head has changed: remove the file to start anew");
  part_ = std::move(found);
} catch (const std::invalid_argument& error) {
  file_.reset();
  refuse(unfinished(), error.what());
}

/// True if OUT is already this part, complete: then it stays.
bool StudyJournal::isDoneAlready() try {
  const MappedFile mapped(out_);
  PartText found = readPart(textIn(mapped));
  finished_ =
      differenceOf(study_, found.study).empty() && found.items == part_.items && missingItems(found).empty();
  if (finished_) part_ = std::move(found);
  if (finished_) std::filesystem::remove(unfinished());
  return finished_;
} catch (const std::exception&) {  // OUT does not exist, or is another result
  return false;
}

std::size_t StudyJournal::answered() const {
  std::size_t count = 0;
  for (const GroupInText& group : part_.groups) count += group.items.size();
  return count;
}

void StudyJournal::add(std::span<const AnsweredGroup> groups) {
  std::string text;
  std::vector<GroupInText> added;
  for (const AnsweredGroup& group : groups) {
    text += textOf(group, head_);
    const std::size_t begin = part_.sound_bytes + text.size() - group.rows.size();
    added.push_back({group.items, begin, group.rows.size(), group.tally});
  }
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) {
    refuse(out_, std::string("cannot be written: ") + std::strerror(errno) + "; the answers so far are in " +
                     unfinished().string());
  }
  part_.sound_bytes += text.size();
  part_.groups.insert(part_.groups.end(), added.begin(), added.end());
}

std::string StudyJournal::rowsOf(const GroupInText& group) {
  std::string rows(group.bytes, '\0');
  if (!seekTo(file_.get(), group.begin) ||
      std::fread(rows.data(), 1, rows.size(), file_.get()) != rows.size()) {
    refuse(unfinished(), "cannot be read back");
  }
  return rows;
}

void StudyJournal::finish() {
  if (finished_) return;
  std::ranges::sort(part_.groups, {}, [](const GroupInText& group) { return group.items.begin; });
  NewFile whole(out_);
  whole.write(form_ == Form::part ? head_ : study_.columns + '\n');
  for (const GroupInText& group : part_.groups) {
    const std::string rows = rowsOf(group);
    whole.write(form_ == Form::part ? textOf({group.items, rows, group.tally}, head_) : rows);
  }
  whole.keep();
  std::error_code ignored;
  if (named_) std::filesystem::remove(unfinished(), ignored);
  file_.reset();
  finished_ = true;
}

std::vector<std::string> StudyJournal::tallies() const {
  std::vector<GroupInText> groups = part_.groups;
  std::ranges::sort(groups, {}, [](const GroupInText& group) { return group.items.begin; });
  std::vector<std::string> result;
  for (GroupInText& group : groups) result.push_back(std::move(group.tally));
  return result;
}

std::filesystem::path StudyJournal::unfinished() const {
  std::filesystem::path name = out_;
  name += ".partial";
  return name;
}

void StudyJournal::refuse(const std::filesystem::path& file, const std::string& message) const {
  throw std::runtime_error(file.string() + ": " + message);
}

}  // namespace octoblisk::demos
