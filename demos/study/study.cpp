#include "study/study.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "io/quoted_text.h"

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

Shard parseShard(const std::string& text) {
  constexpr std::size_t kMaxCount = 1000000;
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto [slash, first_error] = std::from_chars(text.data(), end, shard.index);
  if (first_error == std::errc{} && slash != end && *slash == '/') {
    const auto [stop, error] = std::from_chars(slash + 1, end, shard.count);
    if (error == std::errc{} && stop == end && 1 <= shard.index && shard.index <= shard.count &&
        shard.count <= kMaxCount) {
      return shard;
    }
  }
  throw std::invalid_argument(inQuotes(text) + " is not a part I/N: give 1 <= I <= N <= " +
                              std::to_string(kMaxCount) + ", for example 3/7");
}

ItemRange itemsOf(const Study& study, Shard shard) {
  const std::size_t groups = (study.items + study.group - 1) / study.group;
  const auto border = [&](std::size_t parts_before) {
    const std::size_t whole = groups / shard.count, rest = groups % shard.count;
    const std::size_t groups_before = whole * parts_before + rest * parts_before / shard.count;
    return std::min(study.items, groups_before * study.group);
  };
  return {border(shard.index - 1), border(shard.index)};
}

}  // namespace octoblisk::demos
