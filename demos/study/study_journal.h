// The files that collect answers while a study runs, so that any interrupted run can be continued.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/new_file.h"
#include "study/merge_parts.h"
#include "study/study.h"

namespace octoblisk::demos {

/// The journals of a study are parts (part_text.h) beside the file OUT, which is made from them when all
/// items are answered. Each process writes its own, OUT.partial or, for rank 1, OUT.partial.1, and reads all.
/// If OUT is a device, only rank 0 may have answers; they are kept in memory and lost with the run.
class StudyJournal {
 public:
  enum class Form { table, part };

  /// Reads the journals that are there. With `resume`, continues an unfinished run: a truncated or damaged
  /// end is dropped. A finished part is then kept as it is. Throws std::runtime_error naming the file if OUT
  /// cannot be written, another run is writing it, or an unfinished run exists but is not to be continued or
  /// belongs to another study or part.
  StudyJournal(Study study, ItemRange part, std::filesystem::path out, Form form, bool resume, int rank = 0);

  /// Keeps this process's journal, unless it has no answers.
  ~StudyJournal();
  StudyJournal(const StudyJournal&) = delete;
  StudyJournal& operator=(const StudyJournal&) = delete;

  /// Of all journals, as far as this process knows.
  std::vector<ItemRange> missing() const { return missingItems(known_); }
  std::size_t answered() const;

  /// Makes this process's journal ready for answers. All processes must have read the journals.
  void begin();

  /// Adds answers in any order. The system has them when this returns. Throws std::runtime_error naming OUT.
  void add(std::span<const AnsweredGroup> groups);

  /// Ends this process's journal.
  void close() { file_.reset(); }

  /// Reads the journals of all other processes, which must have closed them.
  void gather() {
    if (named_ && !finished_) readAll();
  }

  /// Makes OUT from all answers, in order, and removes the journals. Returns the tallies of all groups, in
  /// order. Throws std::runtime_error naming OUT.
  std::vector<std::string> finish();

  /// OUT.partial
  std::filesystem::path unfinished(int rank = 0) const;

 private:
  std::vector<std::filesystem::path> journals() const;
  std::vector<PartFile> readAll();
  void requireContinued(const PartFile& found) const;
  bool isDoneAlready();
  void removeIfEmpty();

  Study study_;
  std::filesystem::path out_;
  Form form_;
  bool resume_, named_, has_begun_ = false, finished_ = false;
  int rank_;
  std::string head_;
  PartText known_;             // the groups of all journals
  std::size_t own_bytes_ = 0;  // of this process's journal: its head and groups
  bool has_own_groups_ = false;
  std::string memory_;  // this process's journal, if OUT is a device
  OpenFile file_;
};

}  // namespace octoblisk::demos
