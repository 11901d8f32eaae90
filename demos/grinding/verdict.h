// What the contacts of a pose mean: the belt is there to touch the blade it grinds, and nothing else.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "grinding/grinding_cell.h"
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

/// The verdict of one contact with a blade (0: hub or shroud) of a part whose depth in the blisk is `depth`;
/// null if no depth was found. A contact with a blade that the part may touch is intended up to the part's
/// greatest depth, unknown if the depth is unknown, and clear if the two are apart. Any other touch is
/// interference; any other contact that is apart is a near miss if it is within the pair's margin.
Verdict verdictOf(const PartContact& contact, int blade, const PartDepth* depth, const VerdictRules& rules);

/// The clearance of a part from its obstacles; 0 if it touches one. The blisk is A; points and triangles are
/// those of the whole blisk.
struct PartClearance {
  std::size_t part = 0;
  int blade = 0;
  Clearance clearance;
};

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
  PartClearance at;       ///< at that fraction; for a part that is too deep, its depth as a negative distance
  /// Upper bound of the depth of all parts in the blades that they may touch, mm.
  double depth_bound = 0.0;
  /// Whether all of these parts are proved to stay within their limits (depth_proof.h). Otherwise one exceeds
  /// its limit, or the depth was only measured at some places.
  bool depth_proved = true;

  bool hasFinding() const { return outcome != Outcome::free && outcome != Outcome::not_checked; }
};

/// A pose of the path with its contacts: all of them, or those that reduceContacts keeps.
struct PoseReport {
  Pose tool_in_blisk;
  std::vector<PartContact> contacts;
  std::vector<int> blades;        ///< per contact
  std::vector<PartDepth> depths;  ///< of the parts that touch the blisk or lie in it
  std::vector<int> depth_blades;  ///< per depth: the blade in which the part is deepest
  std::vector<Verdict> verdicts;  ///< per contact
  Verdict verdict = Verdict::clear;
  std::optional<PartClearance> clearance;  ///< the least of all parts; none if nothing is forbidden
  /// Per part, a lower bound of its clearance, as great as the motions need. May be empty.
  std::vector<double> part_clearances;
  std::optional<MotionReport> motion;  ///< from the previous pose
};

/// Sets the verdicts of all contacts and poses. A part wholly inside the blisk, or around it, is
/// interference; the verdict is unknown if this is not known.
void setVerdicts(std::span<PoseReport> poses, const VerdictRules& rules);

/// The touch that decides a pose's verdict.
struct WorstTouch {
  std::size_t part = 0;
  int blade = 0;          ///< that it touches, or in which it is deepest
  int deepest_blade = 0;  ///< in which the part is deepest; `blade` if it is apart
  double depth = 0.0;     ///< of the part in the blisk, on whichever blade; a clearance is negative (mm)
  Vec3 point_on_blisk = Vec3::Zero();
  bool is_inside = false;  ///< one lies wholly inside the other
  std::uint32_t triangle_of_blisk = 0;
  /// Of unit length, in the blisk's frame, from the part into the blisk; zero if no surfaces are near.
  Vec3 normal = Vec3::Zero();
};

/// The touch with the worst verdict and, among these, the deepest part, where it is deepest if possible. None
/// if a judged pose has neither contacts nor depths.
std::optional<WorstTouch> worstTouch(const PoseReport& pose);

/// The same; for a clear pose, the place nearest to an obstacle.
std::optional<WorstTouch> worstOrNearest(const PoseReport& pose);

}  // namespace octoblisk::demos
