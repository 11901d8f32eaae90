// What a walk counts of its own work.
#pragma once

namespace octoblisk::detail {

/// Counts nothing and costs nothing: the tally of all queries but those that are measured.
struct NoTally {
  void boxTest() const {}
  void leafPair() const {}
  void triangleTest() const {}
  void exactTest() const {}
};

}  // namespace octoblisk::detail
