#include "study/answer_mpi.h"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <cstdint>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "study/group_message.h"

namespace octoblisk::demos {
namespace {

constexpr int kItemsTag = 1, kAnswersTag = 2, kFailureTag = 3;
constexpr int kAhead = 2;  ///< messages of items queued per rank, so that it need not wait for the next
constexpr std::chrono::microseconds kBetweenLooks{200};

void sendText(const std::string& text, int rank, int tag) {
  if (text.size() > INT_MAX) throw std::runtime_error("the answers to a group exceed the 2 GB of a message");
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_BYTE, rank, tag, MPI_COMM_WORLD);
}

std::string receiveText(MPI_Status status) {
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::string text(static_cast<std::size_t>(size), '\0');
  MPI_Recv(text.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return text;
}

/// The loop of all ranks but the first: answers until it receives no items.
void follow(const AnswerItems& answer) {
  for (;;) {
    std::uint64_t items[2] = {};
    MPI_Recv(items, 2, MPI_UINT64_T, 0, kItemsTag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (items[0] == items[1]) return;
    try {
      const auto start = std::chrono::steady_clock::now();
      const std::vector<AnsweredGroup> groups = answer({items[0], items[1]});
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
      sendText(packed({groups, time}), 0, kAnswersTag);
    } catch (const std::exception& error) {
      sendText(error.what(), 0, kFailureTag);
    }
  }
}

/// The first rank: hands out items, gathers answers, and answers too, on a thread of its own.
class Lead {
 public:
  Lead(int ranks, Handout& handout, const Ranks::Take& take)
      : handout_(handout), take_(take), others_(static_cast<std::size_t>(ranks)) {}

  void run(const AnswerItems& answer, const std::function<bool()>& stop) {
    for (int rank = 1; rank < count(); ++rank) {
      for (int i = 0; i < kAhead && !others_[rank].dismissed; ++i) sendItems(rank);
    }
    std::jthread here([&] { answerHere(answer); });
    while (!isDone()) {
      const bool has_gathered = gatherFromOthers() | gatherFromHere();
      if (stop()) handOutNoMore();
      if (!has_gathered) std::this_thread::sleep_for(kBetweenLooks);
    }
    here.join();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  struct Other {
    Pace pace;
    int has = 0;  ///< messages of items not yet answered
    bool dismissed = false;
  };

  int count() const { return static_cast<int>(others_.size()); }

  /// Smaller pieces towards the end, so that all ranks finish together.
  ItemRange next(const Pace& pace) {
    const std::lock_guard lock(mutex_);
    return handout_.next(std::min(pace.groups(), handout_.groupsLeft() / (kAhead * others_.size())));
  }

  void handOutNoMore() {
    const std::lock_guard lock(mutex_);
    handout_.clear();
  }

  void fail(std::exception_ptr failure) {
    if (!failure_) failure_ = std::move(failure);
    handOutNoMore();
  }

  void sendItems(int rank) {
    const ItemRange items = next(others_[rank].pace);
    const std::uint64_t message[2] = {items.begin, items.end};
    MPI_Send(message, 2, MPI_UINT64_T, rank, kItemsTag, MPI_COMM_WORLD);
    others_[rank].dismissed = items.empty();
    others_[rank].has += !items.empty();
  }

  void takeAll(const std::vector<AnsweredGroup>& groups) try {
    if (!failure_) take_(groups);
  } catch (...) {
    fail(std::current_exception());
  }

  bool gatherFromOthers() {
    int is_there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &status);
    if (is_there == 0) return false;
    const std::string text = receiveText(status);
    Other& other = others_[status.MPI_SOURCE];
    --other.has;
    if (status.MPI_TAG == kAnswersTag) {
      const GroupMessage message = unpacked(text);
      other.pace.took(message.time);
      takeAll(message.groups);
    } else {
      fail(std::make_exception_ptr(std::runtime_error(text)));
    }
    if (!other.dismissed) sendItems(status.MPI_SOURCE);
    return true;
  }

  void answerHere(const AnswerItems& answer) {
    Pace pace;
    std::exception_ptr failure;
    try {
      for (ItemRange items = next(pace); !items.empty(); items = next(pace)) {
        const auto start = std::chrono::steady_clock::now();
        std::vector<AnsweredGroup> groups = answer(items);
        pace.took(std::chrono::steady_clock::now() - start);
        const std::lock_guard lock(mutex_);
        answered_here_.push_back(std::move(groups));
      }
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    failure_here_ = failure;
    done_here_ = true;
  }

  bool gatherFromHere() {
    std::vector<std::vector<AnsweredGroup>> answered;
    std::exception_ptr failure;
    {
      const std::lock_guard lock(mutex_);
      answered.swap(answered_here_);
      failure = std::exchange(failure_here_, nullptr);
    }
    for (const std::vector<AnsweredGroup>& groups : answered) takeAll(groups);
    if (failure) fail(failure);
    return !answered.empty() || failure;
  }

  bool isDone() {
    const std::lock_guard lock(mutex_);
    return done_here_ && answered_here_.empty() && !failure_here_ &&
           std::ranges::all_of(others_.begin() + 1, others_.end(),
                               [](const Other& other) { return other.dismissed && other.has == 0; });
  }

  std::mutex mutex_;  // guards the handout and `here`
  Handout& handout_;
  std::vector<std::vector<AnsweredGroup>> answered_here_;
  std::exception_ptr failure_here_;
  bool done_here_ = false;
  const Ranks::Take& take_;
  std::vector<Other> others_;  // by rank; the first rank's entry is not used
  std::exception_ptr failure_;
};

}  // namespace

void answerTogether(Handout& handout, const AnswerItems& answer, const Ranks::Take& take,
                    const std::function<bool()>& stop) {
  int rank = 0, count = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  if (rank > 0) return follow(answer);
  Lead(count, handout, take).run(answer, stop);
}

}  // namespace octoblisk::demos
