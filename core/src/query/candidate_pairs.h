// The triangle pairs that may meet, before the exact test.
#pragma once

#include "octoblisk/contact.h"
#include "octoblisk/function_ref.h"
#include "tree/tree.h"

namespace octoblisk::detail {

/// Two triangles that the filter could not separate.
struct CandidatePair {
  TrianglePair triangles;
  bool meets;  ///< certainly; otherwise the exact test decides
};

/// Calls visit(pair) for every pair that meets, and for some that are too close to decide.
void forEachCandidatePair(const Tree& a, const Tree& b, const Pose& b_in_a,
                          FunctionRef<void(CandidatePair pair)> visit);

/// The same for the pairs of different triangles of one tree. Visits each pair once.
void forEachCandidatePairWithin(const Tree& tree, FunctionRef<void(CandidatePair pair)> visit);

/// Whether the two triangles meet. Uses the exact test if the filter could not decide.
bool meet(const Tree& a, const Tree& b, const Pose& b_in_a, const CandidatePair& pair);

}  // namespace octoblisk::detail
