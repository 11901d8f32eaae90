#include "grinding/verdict.h"

#include <algorithm>
#include <tuple>
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
    case Verdict::unknown:
      return "unknown";
    case Verdict::interference:
      return "interference";
  }
  return {};
}

bool VerdictRules::allows(std::size_t part, int blade) const {
  if (blade > blade_count) return false;
  if (part == grinding_part && blade == ground_blade && blade != 0) return true;
  return std::ranges::any_of(allowed, [&](const AllowedPair& pair) {
    return pair.part.value_or(part) == part && pair.blade.includes(blade, ground_blade);
  });
}

double VerdictRules::margin(std::size_t part, int blade) const {
  double margin = near_miss;
  for (const PairMargin& row : margins) {
    if (row.part.value_or(part) == part && row.blade.includes(blade, ground_blade)) margin = row.near_miss;
  }
  return margin;
}

Verdict verdictOf(const PartContact& contact, int blade, const PartDepth* depth, const VerdictRules& rules) {
  const double distance = contact.contact.distance;
  const bool touches = distance <= 0.0;
  if (rules.allows(contact.part, blade)) {
    if (!touches) return Verdict::clear;
    if (depth == nullptr) return Verdict::intended_contact;
    if (depth->depth > rules.maxDepth(contact.part)) return Verdict::interference;
    return depth->is_known ? Verdict::intended_contact : Verdict::unknown;
  }
  if (touches) return Verdict::interference;
  return distance <= rules.margin(contact.part, blade) ? Verdict::near_miss : Verdict::clear;
}

void setVerdicts(std::span<PoseReport> poses, const VerdictRules& rules) {
  for (PoseReport& pose : poses) {
    pose.verdicts.clear();
    pose.verdict = Verdict::clear;
    for (std::size_t c = 0; c < pose.contacts.size(); ++c) {
      const PartContact& contact = pose.contacts[c];
      const auto deepest = std::ranges::find(pose.depths, contact.part, &PartDepth::part);
      pose.verdicts.push_back(
          verdictOf(contact, pose.blades[c], deepest == pose.depths.end() ? nullptr : &*deepest, rules));
      pose.verdict = std::max(pose.verdict, pose.verdicts.back());
    }
    for (const PartDepth& deepest : pose.depths) {
      if (!deepest.is_inside) continue;
      pose.verdict = std::max(pose.verdict, deepest.is_known ? Verdict::interference : Verdict::unknown);
    }
  }
}

std::optional<WorstTouch> worstTouch(const PoseReport& pose) {
  using Rank = std::tuple<Verdict, double, bool, double>;
  std::optional<std::pair<Rank, WorstTouch>> worst;
  const auto consider = [&](const Rank& rank, const WorstTouch& touch) {
    if (!worst || rank > worst->first) worst = {rank, touch};
  };
  for (std::size_t d = 0; d < pose.depths.size(); ++d) {
    const PartDepth& deepest = pose.depths[d];
    const int blade = pose.depth_blades[d];
    if (!deepest.is_inside) continue;
    consider(
        {deepest.is_known ? Verdict::interference : Verdict::unknown, deepest.depth, true, 0.0},
        {deepest.part, blade, blade, deepest.depth, deepest.point_on_blisk, true, deepest.triangle_of_blisk});
  }
  for (std::size_t c = 0; c < pose.contacts.size(); ++c) {
    const auto& [part, contact] = pose.contacts[c];
    WorstTouch touch{part,  pose.blades[c],     pose.blades[c], 0.0 - contact.distance, contact.point_on_a,
                     false, contact.triangle_a, contact.normal};
    const auto deepest = std::ranges::find(pose.depths, part, &PartDepth::part);
    if (contact.distance <= 0.0 && deepest != pose.depths.end()) {
      touch.depth = deepest->depth;
      touch.deepest_blade = pose.depth_blades[static_cast<std::size_t>(deepest - pose.depths.begin())];
    }
    consider({pose.verdicts[c], touch.depth, touch.blade == touch.deepest_blade, -contact.distance}, touch);
  }
  if (!worst) return std::nullopt;
  return worst->second;
}

std::optional<WorstTouch> worstOrNearest(const PoseReport& pose) {
  if (const std::optional<WorstTouch> worst = worstTouch(pose)) return worst;
  if (!pose.clearance) return std::nullopt;
  const auto& [part, blade, clearance] = *pose.clearance;
  const Vec3 towards = clearance.point_on_a - clearance.point_on_b;
  return WorstTouch{part,
                    blade,
                    blade,
                    0.0 - clearance.distance,
                    clearance.point_on_a,
                    false,
                    clearance.triangle_a,
                    towards.normalized()};
}

}  // namespace octoblisk::demos
