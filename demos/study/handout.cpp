#include "study/handout.h"

#include <algorithm>
#include <utility>

namespace octoblisk::demos {

Handout::Handout(std::vector<ItemRange> ranges, std::size_t group)
    : ranges_(std::move(ranges)), group_(group) {}

ItemRange Handout::next(std::size_t groups) {
  if (next_range_ == ranges_.size()) return {};
  ItemRange& range = ranges_[next_range_];
  const ItemRange handed = {range.begin,
                            std::min(range.end, range.begin + std::max<std::size_t>(groups, 1) * group_)};
  range.begin = handed.end;
  if (range.empty()) ++next_range_;
  return handed;
}

std::size_t Handout::groupsLeft() const {
  std::size_t groups = 0;
  for (std::size_t i = next_range_; i < ranges_.size(); ++i) {
    groups += (ranges_[i].size() + group_ - 1) / group_;
  }
  return groups;
}

}  // namespace octoblisk::demos
