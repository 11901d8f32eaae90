#include "grinding/move_check.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "octoblisk/sweep.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr double kLeastRim = 1.0;  // mm: of tools whose belt has no contact wheel at the origin
constexpr int kMostBetween = 10'000;

/// The poses between a move's ends that are judged.
std::vector<Pose> posesBetween(const Move& move, double rim, double step) {
  const Motion motion(move.from, move.to);
  const double way = motion.advance().norm() + motion.angle() * rim;
  const int pieces = static_cast<int>(std::clamp(std::ceil(way / step), 1.0, double{kMostBetween}));
  std::vector<Pose> poses;
  for (int k = 1; k < pieces; ++k) poses.push_back(motion.at(static_cast<double>(k) / pieces));
  return poses;
}

std::optional<Hindrance> sweptInto(const PoseJudge& judge, const Move& move, double clearance) {
  const Motion motion(move.from, move.to);
  for (std::size_t part = 0; part < judge.parts().size(); ++part) {
    const ClusteredOctree* forbidden = judge.forbiddenTo(part);
    if (!forbidden) continue;
    const auto impact = sweep(*forbidden, *judge.parts()[part].tree, motion, clearance);
    if (!impact) continue;
    const std::uint32_t triangle = impact->clearance.triangle_a;
    const int blade = triangle == kNoTriangle ? 0 : judge.bladeOf(judge.numberInBlisk(part, triangle));
    return Hindrance{part, blade, false, false};
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::optional<Hindrance>> checkMoves(PoseJudge& judge, std::span<const Move> moves,
                                                 const MoveCheckOptions& options) {
  const Aabb& belt = judge.parts()[judge.rules().grinding_part].tree->mesh().bounds();
  const double rim = std::max(kLeastRim, -belt.min.x());
  std::vector<Pose> between;
  std::vector<std::size_t> move_of;
  for (std::size_t m = 0; m < moves.size(); ++m) {
    for (const Pose& pose : posesBetween(moves[m], rim, options.step)) {
      between.push_back(pose);
      move_of.push_back(m);
    }
  }
  std::vector<std::optional<Hindrance>> found(moves.size());
  const std::vector<PoseState> states = judge.judge(between);
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (states[k].obstacle && !found[move_of[k]]) found[move_of[k]] = states[k].obstacle;
  }
  parallelFor(moves.size(), judge.threads(), [&](std::size_t m, std::size_t) {
    if (!found[m]) found[m] = sweptInto(judge, moves[m], options.clearance);
  });
  return found;
}

}  // namespace octoblisk::demos
