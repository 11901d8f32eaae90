// What the contacts of a pose mean: the belt is there to touch the blade it grinds, and nothing else.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cell/grinding_cell.h"

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

/// Of one contact with a blade (0: hub or shroud). Of two contacts of a part with a blade, the deeper is
/// never the better. Contacts of the belt with the blade it grinds are intended up to the greatest depth, and
/// clear where the two are apart; any other touch is interference, any other contact that is apart a near
/// miss.
Verdict verdictOf(const PartContact& contact, int blade, const VerdictRules& rules);

/// A pose of the path with its contacts: all of them, or those that reduceContacts keeps.
struct PoseReport {
  Pose tool_in_blisk;
  std::vector<PartContact> contacts;
  std::vector<int> blades;        ///< of each contact
  std::vector<Verdict> verdicts;  ///< of each contact
  Verdict verdict = Verdict::clear;
};

/// The blade that a part touches at the most poses; the lowest number of several, 0 where it touches none.
int mostTouchedBlade(std::span<const PoseReport> poses, std::size_t part);

/// The contact that a judged pose has its verdict from: of the worst verdict, the deepest. None where the
/// pose has no contacts.
std::optional<std::size_t> worstContact(const PoseReport& pose);

/// Sets the verdicts of all contacts and poses.
void judge(std::span<PoseReport> poses, const VerdictRules& rules);

}  // namespace octoblisk::demos
