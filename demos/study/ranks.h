// The processes that answer a study together: those that mpirun started, or only this one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "study/handout.h"
#include "study/shared_bytes.h"
#include "study/study.h"

namespace octoblisk::demos {

/// Every rank calls the same functions in the same order. Two sources implement it: ranks_mpi.cpp if the
/// command is built with MPI (OCTOBLISK_BUILD_MPI), otherwise ranks_alone.cpp.
class Ranks {
 public:
  /// Joins MPI if this process is one of several, and leaves MPI after the last shared memory is released.
  /// Throws std::runtime_error if it is one of several but was built without MPI.
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  bool isFirst() const;
  int count() const;
  int countOnNode() const;  ///< ranks that share this one's memory

  /// The threads that each rank should use: its share of the node's processors, at most as many as it is
  /// bound to.
  int threadsEach() const;

  /// Calls the step. If it throws on any rank, all ranks throw, with the message of the first one that threw.
  void together(const std::function<void()>& step);

  /// Calls `make` on one rank of each node. All ranks of the node then read the result, in the same memory if
  /// the system permits. Throws as together() does.
  SharedBytes oncePerNode(const std::function<std::vector<std::byte>()>& make);

  /// Whether all ranks have the same number.
  bool haveAllTheSame(std::uint64_t number);

  /// Has the ranks answer the whole handout, which only the first rank needs. The first rank takes the
  /// answers as they arrive, in any order, and calls `stop` repeatedly; once that is true, it only waits for
  /// the answers already begun. Throws what `take` throws on the first rank, and what `answer` throws.
  using Take = std::function<void(std::span<const AnsweredGroup>)>;
  void answerAll(Handout& handout, const AnswerItems& answer, const Take& take,
                 const std::function<bool()>& stop);

 private:
  struct Joined;
  std::shared_ptr<Joined> joined_;
};

}  // namespace octoblisk::demos
