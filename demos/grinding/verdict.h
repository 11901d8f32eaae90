// What the contacts of a pose mean: the belt is there to touch the blade it grinds, and nothing else.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "grinding/pair_rules.h"
#include "grinding/part_depths.h"
#include "octoblisk/distance.h"

namespace octoblisk::demos {

/// From harmless to worst; a pose's verdict is the worst of its contacts'. A depth is unknown if the part
/// touches the blisk, or may be inside it, at a place where the blisk's surface does not bound a solid; it
/// counts as interference.
enum class Verdict { clear, intended_contact, near_miss, unknown, interference };

/// "clear", "intended contact", "near miss", "unknown", "interference".
std::string nameOf(Verdict verdict);

/// Depths and distances in mm.
struct VerdictRules {
  std::size_t grinding_part = 0;          ///< the part that may touch: the belt; kNoPart: none
  int ground_blade = 1;                   ///< the blade that the grinding part may touch; 0: none
  double max_depth = 0.1;                 ///< greatest depth of a part in a blade that it may touch
  std::vector<double> max_depths = {};    ///< the same per part; empty: max_depth for all
  std::vector<AllowedPair> allowed = {};  ///< further pairs that may touch
  /// A clearance below this is a near miss; by default every contact that is apart is one.
  double near_miss = std::numeric_limits<double>::infinity();
  /// For some pairs; if several rows match a pair, the last one counts.
  std::vector<PairMargin> margins = {};

  int blade_count = std::numeric_limits<int>::max();  ///< bodies above are fixtures: nothing may touch them

  bool allows(std::size_t part, int blade) const;
  double maxDepth(std::size_t part) const { return max_depths.empty() ? max_depth : max_depths[part]; }
  double margin(std::size_t part, int blade) const;
};

/// A part and a body that touch or are near each other. The body is A of the contact, the part B; points and
/// normal are in the blisk's frame (mm), and A's triangles are those of the surroundings (fixture.h).
struct Touch {
  std::size_t part = 0;
  int blade = 0;  ///< 0: hub or shroud; above the number of blades: a fixture (BodyNames)
  /// The normal is zero if no surfaces are near.
  Contact contact = {};
  double depth = 0.0;      ///< of the part in the blisk, on whichever blade; a clearance is negative (mm)
  int deepest_blade = 0;   ///< in which the part is deepest; `blade` if it is apart
  bool is_inside = false;  ///< one lies wholly inside the other; the contact is the deepest point on the body
  Verdict verdict = Verdict::clear;
};

/// Where a part is nearest to a body.
Touch touchAt(std::size_t part, int blade, const Clearance& nearest);

/// The verdict of a touch of a part whose depth in the blisk is `depth`; null if no depth was found. A touch
/// of a blade that the part may touch is intended up to the part's greatest depth, unknown if the depth is
/// unknown, and clear if the two are apart. Any other touch is interference; if the two are apart, it is a
/// near miss if it is within the pair's margin.
Verdict verdictOf(const Touch& touch, const PartDepth* depth, const VerdictRules& rules);

/// The findings on the motion from the previous pose, apart from those at the two poses.
struct MotionReport {
  enum class Outcome {
    free,  ///< no forbidden touch
    /// A part interferes at one of the two poses, so the motion of this part is not checked.
    not_checked,
    hit,       ///< a forbidden touch that neither of the two poses has
    too_deep,  ///< a part that may touch exceeds its depth limit
    /// The part comes nearer than the tolerance and it is not settled whether it touches, or its depth is
    /// unknown.
    not_proved,
  };
  Outcome outcome = Outcome::free;
  double fraction = 1.0;  ///< of the motion that is free
  Touch at;               ///< at that fraction
  /// Upper bound of the depth of all parts in the blades that they may touch, mm.
  double depth_bound = 0.0;
  double depth_measured = 0.0;  ///< the greatest of their measured depths, those at the two poses included
  /// Whether all of these parts are proved to stay within their limits.
  bool depth_proved = true;

  bool hasFinding() const { return outcome != Outcome::free && outcome != Outcome::not_checked; }
};

/// A pose of the path: what the tool touches there, and the verdict.
struct PoseReport {
  Pose tool_in_blisk;
  std::vector<Touch> touches;
  Verdict verdict = Verdict::clear;
  std::vector<PartDepth> depths;   ///< of the parts that touch the blisk or lie in it
  std::optional<Touch> clearance;  ///< the least of all parts from what they must not touch; none: no such
  /// Per part, a lower bound of its clearance, as great as the motions need. May be empty.
  std::vector<double> part_clearances;
  std::optional<MotionReport> motion;  ///< from the previous pose
};

/// Sets the depths and verdicts of a pose's touches, and its own verdict. Adds a touch for each part wholly
/// inside the blisk, or around it: that is interference; the verdict is unknown if this is not known.
void setVerdicts(PoseReport& pose, const VerdictRules& rules);

/// The touch that decides the verdict of a judged pose: with the worst verdict and, among these, of the
/// deepest part, where it is deepest if possible. Null if nothing touches or is near.
const Touch* worstTouch(const PoseReport& pose);

/// The same; for a clear pose, the place nearest to an obstacle.
const Touch* worstOrNearest(const PoseReport& pose);

}  // namespace octoblisk::demos
