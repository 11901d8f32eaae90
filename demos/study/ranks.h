// The processes that answer a study together: those that mpirun started, or this one alone.
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

/// Every rank calls the same functions in the same order. Two sources define it: ranks_mpi.cpp where the
/// command is built with MPI (OCTOBLISK_BUILD_MPI), else ranks_alone.cpp.
class Ranks {
 public:
  /// Joins MPI where this process is one of several, and leaves it with the last of what it shared. Throws
  /// std::runtime_error where it is one of several, but was built without MPI.
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  bool isFirst() const;
  int count() const;
  int countOnNode() const;  ///< that share this one's memory

  /// The threads that each rank should use: its share of the node's processors, no more than it is bound to.
  int threadsEach() const;

  /// Calls the step. Where it throws at any rank, all throw, with the message of the first that did.
  void together(const std::function<void()>& step);

  /// Calls `make` at one rank of each node; all ranks of the node then read what it returned, in the same
  /// memory where the system lets them. Throws as together() does.
  SharedBytes onceANode(const std::function<std::vector<std::byte>()>& make);

  /// Whether all ranks have this number.
  bool haveAllTheSame(std::uint64_t number);

  /// Has the ranks answer all of the handout, which only the first need have. The first takes the answers as
  /// they come, in any order, and is asked `stop` between whiles; once that is true, what is being answered
  /// is waited for, not more. Throws what `take` throws, at the first rank, and what `answer` throws.
  using Take = std::function<void(std::span<const AnsweredGroup>)>;
  void answerAll(Handout& handout, const AnswerItems& answer, const Take& take,
                 const std::function<bool()>& stop);

 private:
  struct Joined;
  std::shared_ptr<Joined> joined_;
};

}  // namespace octoblisk::demos
