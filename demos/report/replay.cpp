#include "report/replay.h"

#include <array>

namespace octoblisk::demos {

std::string colorOfPart(const std::string& name, std::size_t index) {
  constexpr std::array kOthers = {"#8fc1d9", "#b9a7d6", "#9fc79a", "#d9a58f", "#c2c27a"};
  if (name.starts_with("belt")) return "#e0c48c";
  if (name.starts_with("arm")) return "#6d7f95";
  if (name.ends_with("wheel")) return "#9ecbe4";
  return kOthers[index % kOthers.size()];
}

}  // namespace octoblisk::demos
