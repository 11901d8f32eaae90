// Ranks with MPI; only one thread of each process uses it.
#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>

#include "base/parallel.h"
#include "study/launch.h"
#include "study/ranks.h"

namespace octoblisk::demos {

using namespace detail;

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
  if (launch.count == 1) return;  // initialising MPI takes time
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
                             " processes, but MPI reports " + std::to_string(joined.count) +
                             ": use the launcher of the MPI that this command was built with");
  }
}

Ranks::~Ranks() = default;

int Ranks::rank() const { return joined_->rank; }
int Ranks::count() const { return joined_->count; }

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

SharedBytes Ranks::oncePerNode(const std::function<std::vector<std::byte>()>& make) {
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

  // Each rank maps the memory to its own address, with the same offset within a page.
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

}  // namespace octoblisk::demos
