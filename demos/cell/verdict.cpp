#include "cell/verdict.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace octoblisk::demos {

std::string nameOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::clear:
      return "clear";
    case Verdict::intended_contact:
      return "intended contact";
    case Verdict::near_miss:
      return "near miss";
    case Verdict::interference:
      return "interference";
  }
  return {};
}

Verdict verdictOf(const PartContact& contact, int blade, const VerdictRules& rules) {
  const double distance = contact.contact.distance;
  if (contact.part == rules.grinding_part && blade == rules.ground_blade && blade != 0) {
    if (distance > 0.0) return Verdict::clear;
    return -distance <= rules.max_depth ? Verdict::intended_contact : Verdict::interference;
  }
  return distance > 0.0 ? Verdict::near_miss : Verdict::interference;
}

int mostTouchedBlade(std::span<const PoseReport> poses, std::size_t part) {
  std::map<int, int> poses_of_blade;
  for (const PoseReport& pose : poses) {
    std::set<int> touched;
    for (std::size_t c = 0; c < pose.contacts.size(); ++c) {
      const bool touches = pose.contacts[c].part == part && pose.contacts[c].contact.distance <= 0.0;
      if (touches && pose.blades[c] != 0) touched.insert(pose.blades[c]);
    }
    for (const int blade : touched) ++poses_of_blade[blade];
  }
  const auto most =
      std::ranges::max_element(poses_of_blade, {}, [](const auto& entry) { return entry.second; });
  return most == poses_of_blade.end() ? 0 : most->first;
}

std::optional<std::size_t> worstContact(const PoseReport& pose) {
  if (pose.contacts.empty()) return std::nullopt;
  const auto rank = [&](std::size_t c) {
    return std::pair(pose.verdicts[c], -pose.contacts[c].contact.distance);
  };
  std::size_t worst = 0;
  for (std::size_t c = 1; c < pose.contacts.size(); ++c) {
    if (rank(c) > rank(worst)) worst = c;
  }
  return worst;
}

void judge(std::span<PoseReport> poses, const VerdictRules& rules) {
  for (PoseReport& pose : poses) {
    pose.verdicts.clear();
    pose.verdict = Verdict::clear;
    for (std::size_t c = 0; c < pose.contacts.size(); ++c) {
      pose.verdicts.push_back(verdictOf(pose.contacts[c], pose.blades[c], rules));
      pose.verdict = std::max(pose.verdict, pose.verdicts.back());
    }
  }
}

}  // namespace octoblisk::demos
