#include "study/run_study.h"

#include <exception>
#include <iostream>
#include <span>
#include <stdexcept>

#include "base/checksum.h"
#include "io/progress_bar.h"
#include "study/stop_signal.h"
#include "study/study_journal.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

Stopped stoppedAt(const StudyJournal& journal, std::size_t items, const std::string& out) {
  const std::string done = std::to_string(journal.answered()) + " of " + std::to_string(items) + " answers";
  const bool is_left = journal.answered() > 0 && !isDevice(out);
  return {is_left ? "stopped: " + journal.unfinished().string() + " has " + done + "; continue with --resume"
                  : "stopped after " + done + ", which are lost",
          StopSignal::received()};
}

void requireSameAtAll(Ranks& ranks, const std::string& head) {
  if (ranks.haveAllTheSame(xxh64(std::as_bytes(std::span(head))))) return;
  throw std::runtime_error("input files differ between the nodes: put them in a folder that all nodes share");
}

}  // namespace

StudyOutcome runStudy(const Study& study, const StudyTarget& target,
                      const std::vector<std::filesystem::path>& files_read, Ranks& ranks,
                      const AnswerItems& answer) {
  const ItemRange part = itemsOf(study, target.shard.value_or(Shard{}));
  requireSameAtAll(ranks, headOf(study, part));
  std::optional<StudyJournal> journal;
  ranks.together([&] {
    if (!ranks.isFirst()) return;
    requireNotRead(target.out, files_read);
    using Form = StudyJournal::Form;
    journal.emplace(study, part, target.out, target.shard ? Form::part : Form::table, target.resume);
  });
  Handout handout(journal ? journal->missing() : std::vector<ItemRange>{}, study.group);
  const std::size_t answered_before = journal ? journal->answered() : 0;
  ProgressBar progress(std::cerr, part.size());
  const auto take = [&](std::span<const AnsweredGroup> groups) {
    journal->add(groups);
    progress.update(journal->answered());
  };
  StudyOutcome outcome;
  const StopSignal stop_signal;
  std::exception_ptr failure;
  const auto start = std::chrono::steady_clock::now();
  try {
    ranks.answerAll(handout, answer, take, [] { return StopSignal::received() != 0; });
  } catch (...) {
    failure = std::current_exception();
  }
  outcome.time = std::chrono::steady_clock::now() - start;
  ranks.together([&] {
    if (failure) std::rethrow_exception(failure);
    if (!journal) return;
    if (!journal->missing().empty()) throw stoppedAt(*journal, part.size(), target.out);
    journal->finish();
  });
  if (!journal) return outcome;
  outcome.tallies = journal->tallies();
  outcome.answered = journal->answered() - answered_before;
  return outcome;
}

}  // namespace octoblisk::demos
