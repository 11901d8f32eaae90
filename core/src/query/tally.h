// Counts the work of a search.
#pragma once

namespace octoblisk::detail {

/// Counts nothing and costs nothing: used by all queries except those that are measured.
struct NoTally {
  void boxTest() const {}
  void leafPair() const {}
  void triangleTest() const {}
  void exactTest() const {}
};

}  // namespace octoblisk::detail
