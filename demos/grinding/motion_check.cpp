#include "grinding/motion_check.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "models/belt_grinder.h"
#include "models/shared_tree.h"
#include "octoblisk/sweep.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

bool isInside(const PoseReport& pose, std::size_t part) {
  return std::ranges::any_of(pose.depths,
                             [&](const PartDepth& depth) { return depth.part == part && depth.is_inside; });
}

/// For a part that interferes at one of the poses: the verdict of this pose counts.
void leaveUnchecked(MotionReport& report) {
  if (report.hasFinding()) return;
  report.outcome = MotionReport::Outcome::not_checked;
  report.fraction = 0.0;
}

/// The bound of the depth that is looked for, as a multiple of the greatest depth measured on the motion.
constexpr double kOfMeasured = 1.1;

/// Keeps the earlier of two findings on a motion.
void keepFirst(MotionReport& report, const MotionReport& found) {
  if (report.hasFinding() && report.fraction <= found.fraction) return;
  report.outcome = found.outcome;
  report.fraction = found.fraction;
  report.at = found.at;
}

}  // namespace

/// The depth of a part somewhere on a motion, and the blisk's normal there; zero if it does not touch.
struct MotionCheck::DepthHere {
  double depth = 0.0;
  Vec3 normal = Vec3::Zero();
};

/// No point is deeper on a section of a motion, mm; and whether it is proved that none exceeds the limit.
struct MotionCheck::DepthBound {
  double depth = 0.0;
  bool is_proved = false;
};

/// A section of a motion in which a part may touch.
struct MotionCheck::Stretch {
  Motion motion;                   ///< the whole motion
  MotionReport* report = nullptr;  ///< the findings so far
  std::size_t part = 0;
  double tolerance = 0.0;         ///< of the part's measured depths, mm
  bool is_judged = false;         ///< the motion's outcome is known; only the depth is open
  double begin = 0.0, end = 1.0;  ///< fractions of the motion
  DepthHere at_begin = {}, at_end = {};
  /// No point that may touch goes farther on the whole motion. None: not computed yet.
  std::optional<double> path_length = {};
  std::optional<DepthBound> bound = {};  ///< close enough to the measured depths; none: not found yet

  double length() const { return (end - begin) * path_length.value(); }
  /// Depths are known at both ends; from each end, half of the path length adds to them.
  double depthBound() const { return 0.5 * (at_begin.depth + at_end.depth + length()) + tolerance; }

  void note(const DepthBound& found) const {
    report->depth_bound = std::max(report->depth_bound, found.depth);
    report->depth_proved = report->depth_proved && found.is_proved;
  }
};

MotionCheck::MotionCheck(std::shared_ptr<const ClusteredOctree> blisk, std::span<const ToolPart> parts,
                         const VerdictRules& rules, const Obstacles& obstacles, PartDepths& depths,
                         int threads)
    : blisk_(std::move(blisk)),
      parts_(parts),
      rules_(rules),
      obstacles_(obstacles),
      depths_(depths),
      threads_(threads) {
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const bool may_touch = obstacles.mayTouchAny(part);
    far_parts_.push_back(may_touch ? farPartOf(parts[part].tree->mesh()) : FarPart());
    depth_proofs_.emplace_back();
    if (!may_touch) continue;
    depth_proofs_.back().emplace(depths.blisk(), depths.partSurface(part));
  }
}

MotionCheck::FarPart MotionCheck::farPartOf(const TriangleMesh& part) {
  FarPart found;
  std::vector<TriangleMesh::Indices> far;
  for (std::size_t t = 0; t < part.triangleCount(); ++t) {
    double radius = 0.0;
    for (const Vec3& corner : part.triangle(t)) radius = std::max(radius, corner.norm());
    if (radius > kNearGrinding) {
      far.push_back(part.triangles()[t]);
    } else {
      found.near_radius = std::max(found.near_radius, radius);
    }
  }
  const bool divides = !far.empty() && far.size() < part.triangleCount();
  if (divides) found.tree = treeOf(TriangleMesh(part.vertices(), std::move(far)));
  return found;
}

/// The greatest path length of the part's points, except points that touch nothing during the whole motion.
double MotionCheck::lengthOfTouch(std::size_t part, const Motion& motion) const {
  const FarPart& far = far_parts_[part];
  const double of_all = motion.lengthBound(*parts_[part].tree);
  const double of_near = motion.advance().norm() + motion.angle() * far.near_radius;
  if (!far.tree || of_near >= of_all || of_all <= kDepthStep) return of_all;
  return sweep(*blisk_, *far.tree, motion, kMotionTolerance) ? of_all : of_near;
}

std::vector<MotionReport> MotionCheck::check(std::span<const PoseReport> poses,
                                             std::span<const std::size_t> led_to, double clearance) {
  std::vector<MotionReport> reports(led_to.size());
  std::vector<std::vector<Stretch>> of_motions(led_to.size());
  parallelFor(led_to.size(), threads_, [&](std::size_t m, std::size_t) {
    const PoseReport &from = poses[led_to[m] - 1], &to = poses[led_to[m]];
    sweepMotion(from, to, clearance, reports[m]);
    of_motions[m] = stretchesOf(from, to, reports[m]);
  });
  std::vector<Stretch> open;
  for (const std::vector<Stretch>& of_motion : of_motions)
    open.insert(open.end(), of_motion.begin(), of_motion.end());
  while (!open.empty()) {
    parallelFor(open.size(), threads_, [&](std::size_t i, std::size_t) { open[i].bound = boundOf(open[i]); });
    for (const Stretch& stretch : open) {
      if (stretch.bound) stretch.note(*stretch.bound);
    }
    std::erase_if(open, [](const Stretch& stretch) { return stretch.bound.has_value(); });
    halve(open);
  }
  return reports;
}

void MotionCheck::sweepMotion(const PoseReport& from, const PoseReport& to, double clearance,
                              MotionReport& report) const {
  const Motion motion(from.tool_in_blisk, to.tool_in_blisk);
  const bool has_clearances = !from.part_clearances.empty() && !to.part_clearances.empty();
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const Obstacle* const obstacle = obstacles_.of(part);
    if (!obstacle) continue;
    const auto touches = [&](const PoseReport& pose) {
      return isInside(pose, part) || (has_clearances && pose.part_clearances[part] == 0.0);
    };
    if (touches(from) || touches(to)) {
      leaveUnchecked(report);
      continue;
    }
    if (has_clearances) {
      const double at_from = from.part_clearances[part], at_to = to.part_clearances[part];
      if (at_from + at_to > motion.lengthBound(*parts_[part].tree) + 2.0 * clearance) continue;
    }
    auto met = sweep(obstacle->tree(), *parts_[part].tree, motion, clearance);
    if (!met) continue;
    met->clearance.triangle_a = obstacle->triangleOfAll(met->clearance.triangle_a);
    MotionReport found;
    found.outcome = met->converged ? MotionReport::Outcome::hit : MotionReport::Outcome::not_proved;
    found.fraction = met->fraction;
    found.at = touchAt(part, obstacles_.bodyOfTriangle()[met->clearance.triangle_a], met->clearance);
    keepFirst(report, found);
  }
}

/// The sections of the motion in which parts that may touch can do so.
std::vector<MotionCheck::Stretch> MotionCheck::stretchesOf(const PoseReport& from, const PoseReport& to,
                                                           MotionReport& report) const {
  const Motion motion(from.tool_in_blisk, to.tool_in_blisk);
  std::vector<Stretch> stretches;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    if (!obstacles_.mayTouchAny(part)) continue;
    Stretch stretch{
        .motion = motion, .report = &report, .part = part, .tolerance = depths_.toleranceOf(part)};
    const PartDepth *const at_begin = depthInBlisk(from, part), *const at_end = depthInBlisk(to, part);
    if (at_begin) stretch.at_begin = depthHere(*at_begin);
    if (at_end) stretch.at_end = depthHere(*at_end);
    const double deepest = std::max(stretch.at_begin.depth, stretch.at_end.depth);
    report.depth_measured = std::max(report.depth_measured, deepest);
    if (deepest > rules_.maxDepth(part)) {
      leaveUnchecked(report);
      stretch.is_judged = true;
    }
    if (!at_begin) {
      const auto met = sweep(*blisk_, *parts_[part].tree, motion, kMotionTolerance);
      if (!met) continue;
      stretch.begin = met->fraction;
    }
    stretches.push_back(std::move(stretch));
  }
  return stretches;
}

/// Not the depth in a fixture; null if the part does not touch the blisk.
const PartDepth* MotionCheck::depthInBlisk(const PoseReport& pose, std::size_t part) const {
  const auto found = std::ranges::find_if(pose.depths, [&](const PartDepth& depth) {
    return depth.part == part && depth.triangle_of_blisk < blisk_->mesh().triangleCount();
  });
  return found == pose.depths.end() ? nullptr : &*found;
}

MotionCheck::DepthHere MotionCheck::depthHere(const PartDepth& depth) const {
  return {depth.depth, unitNormal(blisk_->mesh().triangle(depth.triangle_of_blisk))};
}

/// By the proof or by the path length. None: neither bound is close enough to the limit or, where that no
/// longer decides the outcome, to the measured depths.
std::optional<MotionCheck::DepthBound> MotionCheck::boundOf(Stretch& stretch) const {
  const double limit = rules_.maxDepth(stretch.part);
  if (stretch.at_begin.normal.isZero() && stretch.at_end.normal.isZero()) {
    const Motion motion(stretch.motion.at(stretch.begin), stretch.motion.at(stretch.end));
    if (!sweep(*blisk_, *parts_[stretch.part].tree, motion, kMotionTolerance)) return DepthBound{limit, true};
  }
  const MotionReport& report = *stretch.report;
  const bool is_behind =
      report.outcome == MotionReport::Outcome::too_deep && stretch.begin >= report.fraction;
  const bool is_short = stretch.path_length && stretch.length() <= kDepthStep;
  const bool is_judged = stretch.is_judged || is_behind || is_short;
  const double within = is_judged ? std::max(limit, kOfMeasured * report.depth_measured) : limit;
  const Vec3 up = stretch.at_begin.normal + stretch.at_end.normal;
  if (!up.isZero(1e-6) && depth_proofs_[stretch.part]->holds(stretch.motion, stretch.begin, stretch.end,
                                                             up.normalized(), within)) {
    return DepthBound{within, within <= limit};
  }
  if (!stretch.path_length) stretch.path_length = lengthOfTouch(stretch.part, stretch.motion);
  if (stretch.depthBound() > within) return std::nullopt;
  return DepthBound{stretch.depthBound(), stretch.depthBound() <= limit && depths_.blisk().isClosed()};
}

/// Its depth between two places could not be measured.
void MotionCheck::noteUnproved(const Stretch& stretch) const {
  MotionReport& report = *stretch.report;
  if (report.hasFinding()) return;
  report.outcome = MotionReport::Outcome::not_proved;
  report.fraction = stretch.begin;
  const Clearance nearest = distance(*blisk_, *parts_[stretch.part].tree, stretch.motion.at(stretch.begin));
  report.at = touchAt(stretch.part, obstacles_.bodyOfTriangle()[nearest.triangle_a], nearest);
}

void MotionCheck::noteTooDeep(std::size_t part, double fraction, const PartDepth& depth,
                              MotionReport& report) const {
  MotionReport too_deep;
  const bool is_proved = depth.is_known || depth.depth > rules_.maxDepth(part);
  too_deep.outcome = is_proved ? MotionReport::Outcome::too_deep : MotionReport::Outcome::not_proved;
  too_deep.fraction = fraction;
  too_deep.at = {
      .part = part, .blade = obstacles_.bodyOfTriangle()[depth.triangle_of_blisk], .depth = depth.depth};
  too_deep.at.contact = {
      .point_on_a = depth.point_on_blisk, .distance = -depth.depth, .triangle_a = depth.triangle_of_blisk};
  keepFirst(report, too_deep);
}

/// Replaces sections with their halves.
void MotionCheck::halve(std::vector<Stretch>& open) {
  constexpr double kMinPart = 1.0 / 65536;
  std::vector<Stretch> long_ones;
  for (Stretch& stretch : open) {
    if (stretch.end - stretch.begin > kMinPart) {
      long_ones.push_back(std::move(stretch));
      continue;
    }
    if (stretch.length() > kDepthStep) noteUnproved(stretch);
    stretch.note({stretch.depthBound(), false});
  }
  std::vector<std::size_t> parts;
  std::vector<Pose> middles;
  for (const Stretch& stretch : long_ones) {
    parts.push_back(stretch.part);
    middles.push_back(stretch.motion.at(0.5 * (stretch.begin + stretch.end)));
  }
  const auto found = depths_.measure(parts, middles);
  open.clear();
  for (std::size_t i = 0; i < long_ones.size(); ++i) {
    Stretch first = std::move(long_ones[i]), second = first;
    const double middle = 0.5 * (first.begin + first.end);
    first.end = second.begin = middle;
    first.at_end = second.at_begin = found[i] ? depthHere(*found[i]) : DepthHere();
    MotionReport& report = *first.report;
    report.depth_measured = std::max(report.depth_measured, first.at_end.depth);
    const bool is_free = !found[i] || (found[i]->is_known && !found[i]->is_inside &&
                                       found[i]->depth <= rules_.maxDepth(first.part));
    if (!is_free && !first.is_judged) noteTooDeep(first.part, middle, *found[i], report);
    const bool is_known = !found[i] || found[i]->is_known;
    open.push_back(std::move(first));
    if (is_known) {
      open.push_back(std::move(second));
    } else {
      second.note({second.depthBound(), false});
    }
  }
}

}  // namespace octoblisk::demos
