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

/// From harmless to worst; a pose's verdict is the worst of its contacts'. Unknown is how deep a part is that
/// touches the blisk, or may be inside it, where the blisk's surface bounds no solid; it counts as
/// interference.
enum class Verdict { clear, intended_contact, near_miss, unknown, interference };

/// "clear", "intended contact", "near miss", "unknown", "interference".
std::string nameOf(Verdict verdict);

/// Depths and distances in mm.
struct VerdictRules {
  std::size_t grinding_part = 0;          ///< the part that may touch: the belt; kNoPart: none
  int ground_blade = 1;                   ///< the blade that it may touch; 0: none
  double max_depth = 0.1;                 ///< that a part may be pressed into what it may touch
  std::vector<double> max_depths = {};    ///< the same of each part; empty: max_depth for all
  std::vector<AllowedPair> allowed = {};  ///< what else may touch
  /// Below which a clearance is a near miss; by default every contact that is apart is one.
  double near_miss = std::numeric_limits<double>::infinity();
  std::vector<PairMargin> margins = {};  ///< of some pairs; of several rows for a pair the last counts

  int blade_count = std::numeric_limits<int>::max();  ///< what is beyond is a fixture: nothing may touch it

  bool allows(std::size_t part, int blade) const;
  double maxDepth(std::size_t part) const { return max_depths.empty() ? max_depth : max_depths[part]; }
  double margin(std::size_t part, int blade) const;
};

/// Of one contact with a blade (0: hub or shroud) of a part whose depth in the blisk is `depth`; null where
/// it was not found in it. Contacts of a part with what it may touch are intended up to its greatest depth,
/// unknown where that depth is not known to be all, and clear where the two are apart; any other touch is
/// interference, any other contact that is apart a near miss if it is within the pair's margin.
Verdict verdictOf(const PartContact& contact, int blade, const PartDepth* depth, const VerdictRules& rules);

/// How far a part is from what it must not touch; 0 where it touches. The blisk is A; points and triangles
/// are of the whole blisk.
struct PartClearance {
  std::size_t part = 0;
  int blade = 0;
  Clearance clearance;
};

/// What happens between a pose and the one before it, beside what happens at the two.
struct MoveReport {
  enum class Outcome {
    free,      ///< nothing is touched that must not be
    hit,       ///< something is that is not at the two poses
    too_deep,  ///< a part that may touch is deeper than it may
    /// The part comes nearer than the tolerance, and whether it touches was not settled; or its depth is not
    /// known.
    not_proved,
  };
  Outcome outcome = Outcome::free;
  double fraction = 1.0;  ///< of the move, straight and turning evenly, that is free
  PartClearance at;       ///< there; for a part that is too deep, its depth as a negative distance
  /// Of the parts that may touch what they touch: no deeper all the way (mm).
  double depth_bound = 0.0;
  /// Whether it is proved (depth_proof.h) that none of these is deeper than it may be; else one is, or that
  /// was asked at some places.
  bool depth_proved = true;
};

/// A pose of the path with its contacts: all of them, or those that reduceContacts keeps.
struct PoseReport {
  Pose tool_in_blisk;
  std::vector<PartContact> contacts;
  std::vector<int> blades;        ///< of each contact
  std::vector<PartDepth> depths;  ///< of the parts that touch the blisk or lie in it
  std::vector<int> depth_blades;  ///< of each depth: where the part is deepest
  std::vector<Verdict> verdicts;  ///< of each contact
  Verdict verdict = Verdict::clear;
  std::optional<PartClearance> clearance;  ///< the least of all parts'; none where nothing is forbidden
  /// Of each part from what it must not touch; no less, where the moves need no more. May be empty.
  std::vector<double> part_clearances;
  std::optional<MoveReport> move;  ///< from the pose before
};

/// Sets the verdicts of all contacts and poses. A part wholly inside the blisk, or round it, is interference;
/// unknown where it is not known whether it is.
void setVerdicts(std::span<PoseReport> poses, const VerdictRules& rules);

/// What a pose has its verdict from.
struct WorstTouch {
  std::size_t part = 0;
  int blade = 0;          ///< that it touches, or where it is deepest
  int deepest_blade = 0;  ///< where the part is deepest; `blade` where it is apart
  double depth = 0.0;     ///< of the part in the blisk, on whichever blade; a clearance is negative (mm)
  Vec3 point_on_blisk = Vec3::Zero();
  bool is_inside = false;  ///< wholly
  std::uint32_t triangle_of_blisk = 0;
  /// Unit, in the blisk's frame, from the part into the blisk; zero where no surfaces are near.
  Vec3 normal = Vec3::Zero();
};

/// Of the worst verdict, the deepest part, and that where it is deepest if it can be. None where a judged
/// pose has neither contacts nor depths.
std::optional<WorstTouch> worstTouch(const PoseReport& pose);

/// The same, or else where a clear pose comes nearest to what must not be touched.
std::optional<WorstTouch> worstOrNearest(const PoseReport& pose);

}  // namespace octoblisk::demos
