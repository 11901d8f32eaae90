// The processes that answer a study together: those that mpirun started, or only this one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "study/shared_bytes.h"

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

  int rank() const;  ///< from 0
  bool isFirst() const { return rank() == 0; }
  int count() const;

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

 private:
  struct Joined;
  std::shared_ptr<Joined> joined_;
};

}  // namespace octoblisk::demos
