// The search for a pair of triangles that meet, below one node of each tree.
#pragma once

#include <optional>

#include "octoblisk/contact.h"
#include "query/node_pair.h"
#include "tree/tree.h"

namespace octoblisk::detail {

/// Two triangles that meet, and the nodes whose leaves contain them.
struct MeetingPair {
  TrianglePair triangles;
  NodePair nodes;
};

/// Like collide(), but only for the triangles below one node of each tree.
std::optional<MeetingPair> collideBelow(const Tree& a, const Tree& b, const Pose& b_in_a, NodePair below);

}  // namespace octoblisk::detail
