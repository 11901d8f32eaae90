// The pairs of triangles that may meet, before the exact test.
#pragma once

#include <type_traits>

#include "octoblisk/detail/candidate_pair.h"
#include "tree/tree.h"

namespace octoblisk::detail {

/// Calls visit(user, pair) for every pair that meets, and for some too close to call.
void forEachCandidatePair(const Tree& a, const Tree& b, const Pose& b_in_a,
                          void (*visit)(void* user, CandidatePair pair), void* user);

/// The same for anything that can be called with a pair.
template <typename Visit>
void forEachCandidatePair(const Tree& a, const Tree& b, const Pose& b_in_a, Visit&& visit) {
  forEachCandidatePair(
      a, b, b_in_a,
      [](void* user, CandidatePair pair) { (*static_cast<std::remove_reference_t<Visit>*>(user))(pair); },
      &visit);
}

/// Whether the two triangles meet, by the exact test if the filter could not tell.
bool meet(const Tree& a, const Tree& b, const Pose& b_in_a, const CandidatePair& pair);

}  // namespace octoblisk::detail
