// Whether the grinder may go from a pose to the next.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "grinding/pose_judge.h"

namespace octoblisk::demos {

/// A straight move of the tool's origin that turns evenly.
struct Move {
  Pose from, to;
};

struct MoveCheckOptions {
  double clearance = 1e-3;  ///< mm, > 0, that a move must keep all the way: of pairs that must not touch
  double step = 0.5;        ///< mm, > 0: how far apart the belt's depth in the ground blade is asked for
};

/// For each move what is in its way, or nothing. Every pair that must not touch is followed continuously
/// (octoblisk/sweep.h), so that nothing, however thin, is passed through. The belt on the blade that it
/// grinds touches all the way: poses between are judged instead, so close to each other that the contact
/// wheel's centre goes, and its rim turns, by no more than the step together. The ends themselves are not
/// judged.
std::vector<std::optional<Hindrance>> checkMoves(PoseJudge& judge, std::span<const Move> moves,
                                                 const MoveCheckOptions& options);

}  // namespace octoblisk::demos
