// The triangle pairs that may meet, before the exact test.
#pragma once

#include <type_traits>

#include "octoblisk/detail/candidate_pair.h"
#include "tree/tree.h"

namespace octoblisk::detail {

/// Calls visit(user, pair) for every pair that meets, and for some that are too close to decide.
void forEachCandidatePair(const Tree& a, const Tree& b, const Pose& b_in_a,
                          void (*visit)(void* user, CandidatePair pair), void* user);

/// The same for any callable that takes a pair.
template <typename Visit>
void forEachCandidatePair(const Tree& a, const Tree& b, const Pose& b_in_a, Visit&& visit) {
  forEachCandidatePair(
      a, b, b_in_a,
      [](void* user, CandidatePair pair) { (*static_cast<std::remove_reference_t<Visit>*>(user))(pair); },
      &visit);
}

/// Whether the two triangles meet. Uses the exact test if the filter could not decide.
bool meet(const Tree& a, const Tree& b, const Pose& b_in_a, const CandidatePair& pair);

}  // namespace octoblisk::detail
