#include "cell/moves.h"

#include <algorithm>
#include <cmath>

#include "cell/pose_clearances.h"
#include "models/shared_tree.h"
#include "octoblisk/parallel.h"
#include "octoblisk/sweep.h"

namespace octoblisk::demos {
namespace {

constexpr int kMostSamples = 200;  // of a move: a longer one is a mistake, or far from everything

const PartDepth* depthOf(const PoseReport& pose, std::size_t part) {
  const auto found = std::ranges::find(pose.depths, part, &PartDepth::part);
  return found == pose.depths.end() ? nullptr : &*found;
}

double depthAt(const PoseReport& pose, std::size_t part) {
  const PartDepth* const found = depthOf(pose, part);
  return found ? found->depth : 0.0;
}

bool isInside(const PoseReport& pose, std::size_t part) {
  const PartDepth* const found = depthOf(pose, part);
  return found && found->is_inside;
}

bool touches(const PoseReport& pose, std::size_t part) {
  return std::ranges::any_of(pose.contacts, [&](const PartContact& contact) {
    return contact.part == part && contact.contact.distance <= 0.0;
  });
}

/// Keeps the first of what a move meets.
void keepFirst(MoveReport& move, const MoveReport& met) {
  if (move.outcome != MoveReport::Outcome::free && move.fraction <= met.fraction) return;
  move.outcome = met.outcome;
  move.fraction = met.fraction;
  move.at = met.at;
}

}  // namespace

/// A place on a move at which a part's depth is asked for: between its ends.
struct MoveCheck::Sample {
  std::size_t pose = 0;  ///< that the move leads to
  std::size_t part = 0;
  double fraction = 0.0;
  double step = 0.0;  ///< no point of the part goes farther from the sample before, or to the next
  std::optional<PartDepth> depth;
};

MoveCheck::MoveCheck(std::shared_ptr<const ClusteredOctree> blisk, std::span<const ToolPart> parts,
                     std::span<const int> blade_of_triangle, const VerdictRules& rules,
                     const Obstacles& obstacles, PartDepths& depths, int threads)
    : blisk_(std::move(blisk)),
      parts_(parts),
      blade_of_triangle_(blade_of_triangle),
      rules_(rules),
      obstacles_(obstacles),
      depths_(depths),
      threads_(threadCount(threads)) {
  for (std::size_t part = 0; part < parts.size(); ++part) {
    far_parts_.push_back(obstacles.mayTouchAny(part) ? farPartOf(parts[part].tree->mesh()) : FarPart());
  }
}

MoveCheck::FarPart MoveCheck::farPartOf(const TriangleMesh& part) {
  constexpr double kNear = 30.0;  // mm: of the order of a contact wheel
  FarPart found;
  std::vector<TriangleMesh::Indices> far;
  for (std::size_t t = 0; t < part.triangleCount(); ++t) {
    double radius = 0.0;
    for (const Vec3& corner : part.triangle(t)) radius = std::max(radius, corner.norm());
    if (radius > kNear) {
      far.push_back(part.triangles()[t]);
    } else {
      found.near_radius = std::max(found.near_radius, radius);
    }
  }
  const bool divides = !far.empty() && far.size() < part.triangleCount();
  if (divides) found.tree = treeOf(TriangleMesh(part.vertices(), std::move(far)));
  return found;
}

/// How far a point of the part goes at most on a move, but for points that touch nothing on all of it.
double MoveCheck::wayOfTouch(std::size_t part, const Motion& way) const {
  const FarPart& far = far_parts_[part];
  const double of_all = way.lengthBound(*parts_[part].tree);
  const double of_near = way.advance().norm() + way.angle() * far.near_radius;
  if (!far.tree || of_near >= of_all || of_all <= kDepthStep) return of_all;
  return sweep(*blisk_, *far.tree, way, kMoveTolerance) ? of_all : of_near;
}

void MoveCheck::check(std::span<PoseReport> poses) {
  if (poses.size() < 2) return;
  std::vector<std::vector<Sample>> of_moves(poses.size());
  parallelFor(poses.size() - 1, threads_, [&](std::size_t i, std::size_t) {
    poses[i + 1].move.emplace();
    sweepMove(poses[i], poses[i + 1]);
    addSamples(i + 1, poses[i], poses[i + 1], of_moves[i + 1]);
  });
  std::vector<Sample> samples;
  for (const std::vector<Sample>& of_move : of_moves)
    samples.insert(samples.end(), of_move.begin(), of_move.end());

  std::vector<std::size_t> asked_parts;
  std::vector<Pose> asked_poses;
  for (const Sample& sample : samples) {
    const Motion move = moveBetween(poses[sample.pose - 1].tool_in_blisk, poses[sample.pose].tool_in_blisk);
    asked_parts.push_back(sample.part);
    asked_poses.push_back(move.at(sample.fraction));
  }
  const auto found = depths_.measure(asked_parts, asked_poses);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].depth = found[i];

  for (auto begin = samples.begin(); begin != samples.end();) {
    const auto end = std::find_if(begin, samples.end(), [&](const Sample& sample) {
      return sample.pose != begin->pose || sample.part != begin->part;
    });
    apply({begin, end}, poses[begin->pose - 1], poses[begin->pose]);
    begin = end;
  }
}

void MoveCheck::sweepMove(const PoseReport& from, PoseReport& to) const {
  const Motion way = moveBetween(from.tool_in_blisk, to.tool_in_blisk);
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const Obstacle* const obstacle = obstacles_.of(part);
    if (!obstacle || isInside(from, part) || isInside(to, part)) continue;
    const double at_from = from.part_clearances[part], at_to = to.part_clearances[part];
    if (at_from == 0.0 || at_to == 0.0) continue;  // the poses' own verdicts
    if (at_from + at_to > way.lengthBound(*parts_[part].tree) + 2.0 * kMoveTolerance) continue;
    auto met = sweep(obstacle->tree(), *parts_[part].tree, way, kMoveTolerance);
    if (!met) continue;
    met->clearance.triangle_a = obstacle->triangleOfBlisk(met->clearance.triangle_a);
    MoveReport report;
    report.outcome = met->converged ? MoveReport::Outcome::hit : MoveReport::Outcome::not_proved;
    report.fraction = met->fraction;
    report.at = {part, blade_of_triangle_[met->clearance.triangle_a], met->clearance};
    keepFirst(*to.move, report);
  }
}

/// Where a part that may touch may do so on the move, the places to measure its depth at.
void MoveCheck::addSamples(std::size_t pose, const PoseReport& from, PoseReport& to,
                           std::vector<Sample>& samples) const {
  const Motion way = moveBetween(from.tool_in_blisk, to.tool_in_blisk);
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (!obstacles_.mayTouchAny(part) || depths_.kindOf(part) == DepthKind::of_pairs) continue;
    const double limit = rules_.maxDepth(part);
    if (depthAt(from, part) > limit || depthAt(to, part) > limit) continue;
    double begin = 0.0;
    if (!touches(from, part)) {
      const auto met = sweep(*blisk_, *parts_[part].tree, way, kMoveTolerance);
      if (!met) continue;
      begin = met->fraction;
    }
    const double length = (1.0 - begin) * wayOfTouch(part, way);
    const int steps = static_cast<int>(std::clamp(std::ceil(length / kDepthStep), 1.0, double{kMostSamples}));
    if (steps == 1) {
      const double bound = 0.5 * (depthAt(from, part) + depthAt(to, part) + length);
      to.move->depth_bound = std::max(to.move->depth_bound, bound);
    }
    for (int k = 1; k < steps; ++k) {
      const double fraction = begin + (1.0 - begin) * k / steps;
      samples.push_back({pose, part, fraction, length / steps, std::nullopt});
    }
  }
}

void MoveCheck::apply(std::span<const Sample> samples, const PoseReport& from, PoseReport& to) const {
  MoveReport& move = *to.move;
  const std::size_t part = samples.front().part;
  double before = depthAt(from, part);
  for (const Sample& sample : samples) {
    const double here = sample.depth ? sample.depth->depth : 0.0;
    move.depth_bound = std::max(move.depth_bound, 0.5 * (before + here + sample.step));
    before = here;
    if (here <= rules_.maxDepth(part) && !(sample.depth && sample.depth->is_inside)) continue;
    MoveReport too_deep;
    too_deep.outcome = MoveReport::Outcome::too_deep;
    too_deep.fraction = sample.fraction;
    too_deep.at = {part, blade_of_triangle_[sample.depth->triangle_of_blisk], {}};
    too_deep.at.clearance.distance = -here;
    too_deep.at.clearance.point_on_a = sample.depth->point_on_blisk;
    too_deep.at.clearance.triangle_a = sample.depth->triangle_of_blisk;
    keepFirst(move, too_deep);
  }
  move.depth_bound = std::max(move.depth_bound, 0.5 * (before + depthAt(to, part) + samples.back().step));
}

}  // namespace octoblisk::demos
