#include "study/run_study.h"

#include <algorithm>
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

/// The number of groups to answer at a time: enough to be efficient, few enough that an interruption loses
/// little.
class Pace {
 public:
  std::size_t groups() const { return groups_; }

  void took(std::chrono::duration<double> time) {
    constexpr std::chrono::duration<double> kShort{0.05}, kLong{0.5};
    constexpr std::size_t kMaxGroups = 4096;
    if (time < kShort && groups_ < kMaxGroups) groups_ *= 2;
    if (time > kLong && groups_ > 1) groups_ /= 2;
  }

 private:
  std::size_t groups_ = 4;
};

/// The items that a rank answers: every rank takes blocks of whole groups in turn, because neighbouring items
/// take about the same time.
std::vector<ItemRange> shareOf(const Ranks& ranks, const std::vector<ItemRange>& items, const Study& study) {
  const auto count = static_cast<std::size_t>(ranks.count());
  if (count == 1) return items;
  constexpr std::size_t kMaxGroups = 8;  // of a block
  std::size_t all = 0, number = 0;
  for (const ItemRange& range : items) all += range.size();
  const std::size_t groups = std::clamp<std::size_t>(all / study.group / (kMaxGroups * count), 1, kMaxGroups);
  std::vector<ItemRange> share;
  for (ItemRange range : items) {
    while (!range.empty()) {
      const std::size_t end = std::min(range.end, range.begin + groups * study.group);
      if (number++ % count == static_cast<std::size_t>(ranks.rank())) share.push_back({range.begin, end});
      range.begin = end;
    }
  }
  return share;
}

/// Throws if answers are missing: Stopped if a signal is the reason.
void requireAllAnswered(const StudyJournal& journal, std::size_t items, const std::string& out) {
  if (journal.missing().empty()) return;
  const std::string done = std::to_string(journal.answered()) + " of " + std::to_string(items) + " answers";
  const std::string left = journal.unfinished().string() + " has " + done + "; continue with --resume";
  if (StopSignal::received() == 0)
    throw std::runtime_error(left + ", and put the file in a folder that all nodes share");
  const bool is_left = journal.answered() > 0 && !isDevice(out);
  throw Stopped("stopped" + (is_left ? ": " + left : " after " + done + ", which are lost"),
                StopSignal::received());
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
    requireNotRead(target.out, files_read);
    using Form = StudyJournal::Form;
    journal.emplace(study, part, target.out, target.shard ? Form::part : Form::table, target.resume,
                    ranks.rank());
  });
  const std::size_t answered_before = journal->answered();
  std::vector<ItemRange> share = shareOf(ranks, journal->missing(), study);
  if (isDevice(target.out)) share = ranks.isFirst() ? journal->missing() : std::vector<ItemRange>{};
  std::size_t items = 0;
  for (const ItemRange& range : share) items += range.size();
  std::optional<ProgressBar> progress;
  if (ranks.isFirst()) progress.emplace(std::cerr, answered_before + items);
  StudyOutcome outcome;
  const StopSignal stop_signal;
  ranks.together([&] { journal->begin(); });
  const auto start = std::chrono::steady_clock::now();
  ranks.together([&] {
    Pace pace;
    for (ItemRange range : share) {
      while (!range.empty() && StopSignal::received() == 0) {
        const auto begun = std::chrono::steady_clock::now();
        const std::size_t end = std::min(range.end, range.begin + pace.groups() * study.group);
        const std::vector<AnsweredGroup> groups = answer({range.begin, end});
        pace.took(std::chrono::steady_clock::now() - begun);
        journal->add(groups);
        if (progress) progress->update(journal->answered());
        range.begin = end;
      }
    }
    outcome.time = std::chrono::steady_clock::now() - start;
    if (!ranks.isFirst()) journal->close();
  });
  ranks.together([&] {
    if (!ranks.isFirst()) return;
    journal->gather();
    outcome.answered = journal->answered() - answered_before;
    requireAllAnswered(*journal, part.size(), target.out);
    outcome.tallies = journal->finish();
  });
  return outcome;
}

}  // namespace octoblisk::demos
