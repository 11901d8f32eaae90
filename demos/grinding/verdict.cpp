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

Touch touchAt(std::size_t part, int blade, const Clearance& nearest) {
  const Vec3 normal = (nearest.point_on_a - nearest.point_on_b).normalized();
  return {part,
          blade,
          {nearest.point_on_a, nearest.point_on_b, normal, nearest.distance, nearest.triangle_a,
           nearest.triangle_b},
          0.0 - nearest.distance,
          blade};
}

Verdict verdictOf(const Touch& touch, const PartDepth* depth, const VerdictRules& rules) {
  const double distance = touch.contact.distance;
  const bool touches = distance <= 0.0;
  if (rules.allows(touch.part, touch.blade)) {
    if (!touches) return Verdict::clear;
    if (depth == nullptr) return Verdict::intended_contact;
    if (depth->depth > rules.maxDepth(touch.part)) return Verdict::interference;
    return depth->is_known ? Verdict::intended_contact : Verdict::unknown;
  }
  if (touches) return Verdict::interference;
  return distance <= rules.margin(touch.part, touch.blade) ? Verdict::near_miss : Verdict::clear;
}

void setVerdicts(PoseReport& pose, const VerdictRules& rules) {
  for (Touch& touch : pose.touches) {
    const auto found = std::ranges::find(pose.depths, touch.part, &PartDepth::part);
    const PartDepth* const deepest = found == pose.depths.end() ? nullptr : &*found;
    const bool has_depth = deepest && touch.contact.distance <= 0.0;
    touch.depth = has_depth ? deepest->depth : 0.0 - touch.contact.distance;
    touch.deepest_blade = has_depth ? deepest->blade : touch.blade;
    touch.verdict = verdictOf(touch, deepest, rules);
  }
  for (const PartDepth& deepest : pose.depths) {
    if (!deepest.is_inside) continue;
    Touch inside{.part = deepest.part,
                 .blade = deepest.blade,
                 .depth = deepest.depth,
                 .deepest_blade = deepest.blade,
                 .is_inside = true};
    inside.contact = {.point_on_a = deepest.point_on_blisk,
                      .normal = Vec3::Zero(),
                      .triangle_a = deepest.triangle_of_blisk};
    inside.verdict = deepest.is_known ? Verdict::interference : Verdict::unknown;
    pose.touches.push_back(inside);
  }
  pose.verdict = Verdict::clear;
  for (const Touch& touch : pose.touches) pose.verdict = std::max(pose.verdict, touch.verdict);
}

const Touch* worstTouch(const PoseReport& pose) {
  // Of equally bad ones, a part that is wholly inside counts first.
  const auto rank = [](const Touch& touch) {
    return std::tuple(touch.verdict, touch.depth, touch.blade == touch.deepest_blade, -touch.contact.distance,
                      touch.is_inside);
  };
  const auto worst = std::ranges::max_element(pose.touches, {}, rank);
  return worst == pose.touches.end() ? nullptr : &*worst;
}

const Touch* worstOrNearest(const PoseReport& pose) {
  if (const Touch* const worst = worstTouch(pose)) return worst;
  return pose.clearance ? &*pose.clearance : nullptr;
}

}  // namespace octoblisk::demos
