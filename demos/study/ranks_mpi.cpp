// Ranks of MPI, of which one thread of each process knows.
#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <climits>
#include <cstring>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "octoblisk/parallel.h"
#include "study/answer_alone.h"
#include "study/group_message.h"
#include "study/launch.h"
#include "study/ranks.h"

namespace octoblisk::demos {
namespace {

constexpr int kItemsTag = 1, kAnswersTag = 2, kFailureTag = 3;
constexpr int kAhead = 2;  ///< messages of items a rank has, so that it need not wait for the next
constexpr std::chrono::microseconds kBetweenLooks{200};

void sendText(const std::string& text, int rank, int tag) {
  if (text.size() > INT_MAX) throw std::runtime_error("the answers to a group are beyond a message's 2 GB");
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_BYTE, rank, tag, MPI_COMM_WORLD);
}

std::string receiveText(MPI_Status status) {
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::string text(static_cast<std::size_t>(size), '\0');
  MPI_Recv(text.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return text;
}

/// What the ranks behind the first do: answers until it is sent no items.
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

/// What the first rank does: hands out, gathers, and answers too, on a thread of its own.
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
    int has = 0;  ///< messages of items that it has not answered
    bool dismissed = false;
  };

  int count() const { return static_cast<int>(others_.size()); }

  /// Fewer towards the end, so that all end together.
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

  std::mutex mutex_;  // of the handout and of what is `here`
  Handout& handout_;
  std::vector<std::vector<AnsweredGroup>> answered_here_;
  std::exception_ptr failure_here_;
  bool done_here_ = false;
  const Ranks::Take& take_;
  std::vector<Other> others_;  // by rank; that of the first is not used
  std::exception_ptr failure_;
};

}  // namespace

struct Ranks::Joined {
  bool has_mpi = false;
  int rank = 0, count = 1, rank_on_node = 0, count_on_node = 1;
  MPI_Comm node = MPI_COMM_NULL;
  std::vector<MPI_Win> windows;

  Joined() = default;
  Joined(const Joined&) = delete;
  Joined& operator=(const Joined&) = delete;
  ~Joined() {
    if (!has_mpi) return;
    for (MPI_Win& window : windows) MPI_Win_free(&window);
    MPI_Comm_free(&node);
    MPI_Finalize();
  }
};

Ranks::Ranks() : joined_(std::make_shared<Joined>()) {
  const Launch launch = launchedAs();
  if (launch.count == 1) return;  // MPI takes its time to begin
  int threads = MPI_THREAD_SINGLE;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &threads);
  Joined& joined = *joined_;
  joined.has_mpi = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &joined.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &joined.count);
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &joined.node);
  MPI_Comm_rank(joined.node, &joined.rank_on_node);
  MPI_Comm_size(joined.node, &joined.count_on_node);
  if (joined.count != launch.count) {
    throw std::runtime_error("the launcher started " + std::to_string(launch.count) +
                             " processes, but MPI tells of " + std::to_string(joined.count) +
                             ": it is the launcher of another MPI");
  }
}

Ranks::~Ranks() = default;

bool Ranks::isFirst() const { return joined_->rank == 0; }
int Ranks::count() const { return joined_->count; }
int Ranks::countOnNode() const { return joined_->count_on_node; }

int Ranks::threadsEach() const {
  const int share = threadCount(0) / joined_->count_on_node;
  cpu_set_t bound_to;
  CPU_ZERO(&bound_to);
  const bool is_known = ::sched_getaffinity(0, sizeof(bound_to), &bound_to) == 0;
  return std::max(1, is_known ? std::min(share, CPU_COUNT(&bound_to)) : share);
}

void Ranks::together(const std::function<void()>& step) {
  const int all = joined_->count, rank = joined_->rank;
  if (all == 1) return step();
  std::exception_ptr failure;
  std::string message;
  try {
    step();
  } catch (const std::exception& error) {
    failure = std::current_exception();
    message = error.what();
  }
  int failed = failure ? rank : all, first_failed = all;
  MPI_Allreduce(&failed, &first_failed, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (first_failed == all) return;
  auto size = static_cast<int>(message.size());
  MPI_Bcast(&size, 1, MPI_INT, first_failed, MPI_COMM_WORLD);
  message.resize(static_cast<std::size_t>(size));
  MPI_Bcast(message.data(), size, MPI_BYTE, first_failed, MPI_COMM_WORLD);
  if (first_failed == rank) std::rethrow_exception(failure);
  throw std::runtime_error(message);
}

SharedBytes Ranks::onceANode(const std::function<std::vector<std::byte>()>& make) {
  if (joined_->count == 1) return alignedCopy(make());
  const bool makes = joined_->rank_on_node == 0;
  const MPI_Comm node = joined_->node;
  std::vector<std::byte> made;
  together([&] {
    if (makes) made = make();
  });
  std::uint64_t size = made.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, node);
  const auto room = static_cast<MPI_Aint>(makes ? size + kSharedAlignment : 0);
  MPI_Win& window = joined_->windows.emplace_back();
  void* begin = nullptr;
  MPI_Win_allocate_shared(room, 1, MPI_INFO_NULL, node, &begin, &window);
  MPI_Aint of_maker = 0;
  int unit = 0;
  MPI_Win_shared_query(window, 0, &of_maker, &unit, &begin);

  // Each rank has the memory at an address of its own, all at the same place of a page.
  const auto misaligned = [](const void* address) {
    return reinterpret_cast<std::uintptr_t>(address) % kSharedAlignment;
  };
  std::uint64_t offset = (kSharedAlignment - misaligned(begin)) % kSharedAlignment;
  MPI_Bcast(&offset, 1, MPI_UINT64_T, 0, node);
  std::byte* const bytes = static_cast<std::byte*>(begin) + offset;
  MPI_Win_fence(0, window);
  if (makes && size > 0) std::memcpy(bytes, made.data(), size);
  MPI_Win_fence(0, window);
  if (misaligned(bytes) != 0) return alignedCopy({bytes, size});
  return {{bytes, size}, joined_};
}

bool Ranks::haveAllTheSame(std::uint64_t number) {
  if (joined_->count == 1) return true;
  std::uint64_t least = 0, greatest = 0;
  MPI_Allreduce(&number, &least, 1, MPI_UINT64_T, MPI_MIN, MPI_COMM_WORLD);
  MPI_Allreduce(&number, &greatest, 1, MPI_UINT64_T, MPI_MAX, MPI_COMM_WORLD);
  return least == greatest;
}

void Ranks::answerAll(Handout& handout, const AnswerItems& answer, const Take& take,
                      const std::function<bool()>& stop) {
  if (joined_->count == 1) return answerAlone(handout, answer, take, stop);
  if (!isFirst()) return follow(answer);
  Lead(joined_->count, handout, take).run(answer, stop);
}

}  // namespace octoblisk::demos
