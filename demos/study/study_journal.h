// The file that collects answers while a study runs, so that any interrupted run can be continued.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/new_file.h"
#include "study/part_text.h"
#include "study/study.h"

namespace octoblisk::demos {

/// OUT.partial is a part (part_text.h) of a study, beside the file OUT, which is made from it when all items
/// are answered. If OUT is a device, it is a file without a name, which is lost with the run.
class StudyJournal {
 public:
  enum class Form { table, part };

  /// Begins a file or, with `resume`, continues that of an unfinished run: a truncated or damaged end is
  /// dropped. A finished part is then kept as it is. Throws std::runtime_error naming the file if OUT cannot
  /// be written, another run is writing it, or an unfinished run exists but is not to be continued or belongs
  /// to another study or part.
  StudyJournal(Study study, ItemRange part, std::filesystem::path out, Form form, bool resume);

  /// Keeps OUT.partial, unless it has no answers.
  ~StudyJournal();
  StudyJournal(const StudyJournal&) = delete;
  StudyJournal& operator=(const StudyJournal&) = delete;

  std::vector<ItemRange> missing() const { return missingItems(part_); }
  std::size_t answered() const;

  /// In any order. The system has them when this returns. Throws std::runtime_error naming OUT.
  void add(std::span<const AnsweredGroup> groups);

  /// Makes OUT from all answers, in order, and removes OUT.partial. Throws std::runtime_error naming OUT.
  void finish();

  /// Of all groups in the file, in order.
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
