#include "study/study.h"

#include <algorithm>

namespace octoblisk::demos {

std::string differenceOf(const Study& first, const Study& second) {
  if (first.name != second.name) return "subcommand";
  const auto [one, other] = std::ranges::mismatch(first.inputs, second.inputs);
  if (one != first.inputs.end()) return one->name;
  if (other != second.inputs.end()) return other->name;
  if (first.options != second.options || first.columns != second.columns) return "options";
  if (first.items != second.items || first.group != second.group) return "items";
  return {};
}

}  // namespace octoblisk::demos
