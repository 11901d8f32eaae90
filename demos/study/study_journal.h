// The file in which answers gather while a study runs: whatever ends the run, it can go on from there.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/new_file.h"
#include "study/part_text.h"
#include "study/study.h"

namespace octoblisk::demos {

/// OUT.partial, a part (part_text.h) of a study, beside the file OUT that is made of it when all is answered.
/// Where OUT is a device, it is a nameless file, lost with the run.
class StudyJournal {
 public:
  enum class Form { table, part };

  /// Begins, or goes on from what an unfinished run left if told to `resume`: what is cut off or damaged at
  /// its end is dropped. A finished part is taken as it is then. Throws std::runtime_error naming the file
  /// where OUT cannot be written, another run is writing it, an unfinished run is there but not to be
  /// resumed, or is of another study or part.
  StudyJournal(Study study, ItemRange part, std::filesystem::path out, Form form, bool resume);

  /// Leaves OUT.partial, unless there is no answer in it.
  ~StudyJournal();
  StudyJournal(const StudyJournal&) = delete;
  StudyJournal& operator=(const StudyJournal&) = delete;

  std::vector<ItemRange> missing() const { return missingItems(part_); }
  std::size_t answered() const;

  /// In any order. They are with the system when this returns. Throws std::runtime_error naming OUT.
  void add(std::span<const AnsweredGroup> groups);

  /// Makes OUT of all answers, in order, and removes OUT.partial. Throws std::runtime_error naming OUT.
  void finish();

  /// Of all groups there are, in order.
  std::vector<std::string> tallies() const;

  /// OUT.partial
  std::filesystem::path unfinished() const;

 private:
  void open();
  bool isDoneAlready();
  void readBack();
  bool goesToItsEnd();
  void removeIfEmpty();
  std::string rowsOf(const GroupInText& group);
  [[noreturn]] void refuse(const std::filesystem::path& file, const std::string& message) const;

  Study study_;
  std::filesystem::path out_;
  Form form_;
  bool resume_, named_, finished_ = false;
  std::string head_;
  PartText part_;
  OpenFile file_;
};

}  // namespace octoblisk::demos
