// What the contacts of a pose mean: the belt is there to touch the blade it grinds, and nothing else.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cell/grinding_cell.h"
#include "cell/part_depths.h"

namespace octoblisk::demos {

/// From harmless to worst; a pose's verdict is the worst of its contacts'.
enum class Verdict { clear, intended_contact, near_miss, interference };

/// "clear", "intended contact", "near miss", "interference".
std::string nameOf(Verdict verdict);

struct VerdictRules {
  std::size_t grinding_part = 0;  ///< the part that may touch: the belt
  int ground_blade = 1;           ///< the blade that it may touch
  double max_depth = 0.1;         ///< mm that it may be pressed into it
};

/// Of one contact with a blade (0: hub or shroud) of a part that is `depth` (mm) deep in the blisk, if it
/// touches it. Contacts of the belt with the blade it grinds are intended up to the greatest depth, and clear
/// where the two are apart; any other touch is interference, any other contact that is apart a near miss.
Verdict verdictOf(const PartContact& contact, int blade, double depth, const VerdictRules& rules);

/// A pose of the path with its contacts: all of them, or those that reduceContacts keeps.
struct PoseReport {
  Pose tool_in_blisk;
  std::vector<PartContact> contacts;
  std::vector<int> blades;        ///< of each contact
  std::vector<PartDepth> depths;  ///< of the parts that touch the blisk or lie in it
  std::vector<int> depth_blades;  ///< of each depth: where the part is deepest
  std::vector<Verdict> verdicts;  ///< of each contact
  Verdict verdict = Verdict::clear;
};

/// The blade that a part touches at the most poses; the lowest number of several, 0 where it touches none.
int mostTouchedBlade(std::span<const PoseReport> poses, std::size_t part);

/// Sets the verdicts of all contacts and poses. A part wholly inside the blisk, or round it, is interference.
void judge(std::span<PoseReport> poses, const VerdictRules& rules);

/// What a pose has its verdict from.
struct WorstTouch {
  std::size_t part = 0;
  int blade = 0;          ///< that it touches, or where it is deepest
  int deepest_blade = 0;  ///< where the part is deepest; `blade` where it is apart
  double depth = 0.0;     ///< of the part in the blisk, on whichever blade; a clearance is negative (mm)
  Vec3 point_on_blisk = Vec3::Zero();
  bool is_inside = false;  ///< wholly
};

/// Of the worst verdict, the deepest part, and that where it is deepest if it can be. None where a judged
/// pose has neither contacts nor depths.
std::optional<WorstTouch> worstTouch(const PoseReport& pose);

}  // namespace octoblisk::demos
