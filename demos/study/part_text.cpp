#include "study/part_text.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <span>
#include <stdexcept>

#include "base/checksum.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr std::string_view kMagic = "# octoblisk study part 1\n";
constexpr int kHexadecimal = 16;

std::uint64_t checksumOf(std::string_view text, std::uint64_t seed = 0) {
  return xxh64(std::as_bytes(std::span(text)), seed);
}

std::string hexOf(std::uint64_t value) {
  constexpr std::size_t kDigits = 16;
  char digits[kDigits];
  const char* const end = std::to_chars(digits, digits + kDigits, value, kHexadecimal).ptr;
  const auto count = static_cast<std::size_t>(end - digits);
  return std::string(kDigits - count, '0') + std::string(digits, count);
}

/// Parses a text from its beginning. A mismatch sets `failed`, and nothing more is parsed.
class TextParts {
 public:
  explicit TextParts(std::string_view text) : text_(text) {}

  bool failed() const { return failed_; }
  std::size_t position() const { return position_; }
  bool beginsWith(std::string_view word) const { return !failed_ && rest().starts_with(word); }

  TextParts& skip(std::string_view word) {
    failed_ = !beginsWith(word);
    if (!failed_) position_ += word.size();
    return *this;
  }

  TextParts& number(std::size_t& value) { return integer(value, 10); }
  TextParts& hex(std::uint64_t& value) { return integer(value, kHexadecimal); }

  /// Up to the delimiter, which is skipped.
  TextParts& upTo(char delimiter, std::string& value) {
    const std::size_t length = failed_ ? std::string_view::npos : rest().find(delimiter);
    failed_ = length == std::string_view::npos;
    if (failed_) return *this;
    value = rest().substr(0, length);
    position_ += length + 1;
    return *this;
  }

  /// This number of bytes.
  TextParts& take(std::size_t count, std::string_view& value) {
    failed_ = failed_ || rest().size() < count;
    if (failed_) return *this;
    value = rest().substr(0, count);
    position_ += count;
    return *this;
  }

 private:
  std::string_view rest() const { return text_.substr(position_); }

  template <typename Number>
  TextParts& integer(Number& value, int base) {
    if (failed_) return *this;
    const auto [stop, error] = std::from_chars(rest().data(), rest().data() + rest().size(), value, base);
    failed_ = error != std::errc{};
    position_ += static_cast<std::size_t>(stop - rest().data());
    return *this;
  }

  std::string_view text_;
  std::size_t position_ = 0;
  bool failed_ = false;
};

/// Printable and without spaces, so that messages can show it.
bool isWord(std::string_view name) {
  return !name.empty() &&
         std::ranges::all_of(name, [](char letter) { return letter > ' ' && letter <= '~'; });
}

std::vector<ItemRange> answeredItems(const PartText& part) {
  std::vector<ItemRange> answered;
  for (const GroupInText& group : part.groups) answered.push_back(group.items);
  std::ranges::sort(answered, {}, &ItemRange::begin);
  return answered;
}

void requireOnce(const PartText& part) {
  std::size_t end = part.items.begin;
  for (const ItemRange& items : answeredItems(part)) {
    if (items.begin < end) throw std::invalid_argument("repeats item " + std::to_string(items.begin));
    end = items.end;
  }
}

/// A group's line without its checksum.
std::string describedGroup(ItemRange items, std::size_t bytes, const std::string& tally) {
  return std::to_string(items.begin) + " to " + std::to_string(items.end) + ", " + std::to_string(bytes) +
         " bytes, tally " + tally;
}

std::uint64_t checksumOf(const std::string& described, std::string_view rows, std::uint64_t head_checksum) {
  return checksumOf(rows, checksumOf(described, head_checksum));
}

/// The next group, if it is complete and its checksum is right.
std::optional<GroupInText> readGroup(TextParts& text, const PartText& part, std::uint64_t head_checksum) {
  GroupInText group;
  std::uint64_t checksum = 0;
  std::string_view rows;
  text.skip("# checksum ").hex(checksum).skip(", items ").number(group.items.begin).skip(" to ");
  text.number(group.items.end).skip(", ").number(group.bytes).skip(" bytes, tally ").upTo('\n', group.tally);
  group.begin = text.position();
  text.take(group.bytes, rows);
  const ItemRange& items = group.items;
  if (text.failed() || items.begin >= items.end) return std::nullopt;
  if (items.begin < part.items.begin || items.end > part.items.end) return std::nullopt;
  const std::string described = describedGroup(group.items, group.bytes, group.tally);
  if (checksum != checksumOf(described, rows, head_checksum)) return std::nullopt;
  return group;
}

}  // namespace

std::string headOf(const Study& study, ItemRange part) {
  std::string head(kMagic);
  head += "# study " + study.name + '\n';
  head += "# items " + std::to_string(part.begin) + " to " + std::to_string(part.end) + " of " +
          std::to_string(study.items) + ", in groups of " + std::to_string(study.group) + '\n';
  for (const StudyInput& input : study.inputs) {
    head += "# input " + input.name + ' ' + hexOf(input.fingerprint) + '\n';
  }
  head += "# options " + study.options + '\n' + study.columns + '\n';
  return head;
}

std::string textOf(const AnsweredGroup& group, std::string_view head) {
  const std::string described = describedGroup(group.items, group.rows.size(), group.tally);
  return "# checksum " + hexOf(checksumOf(described, group.rows, checksumOf(head))) + ", items " + described +
         '\n' + group.rows;
}

PartText readPart(std::string_view text) {
  PartText part;
  Study& study = part.study;
  TextParts parts(text);
  parts.skip(kMagic);
  if (parts.failed()) throw std::invalid_argument("is not a part of a study: its first line does not match");
  parts.skip("# study ").upTo('\n', study.name);
  parts.skip("# items ").number(part.items.begin).skip(" to ").number(part.items.end).skip(" of ");
  parts.number(study.items).skip(", in groups of ").number(study.group).skip("\n");
  bool are_words = true;
  while (parts.beginsWith("# input ")) {
    StudyInput input;
    parts.skip("# input ").upTo(' ', input.name).hex(input.fingerprint).skip("\n");
    are_words = are_words && isWord(input.name);
    study.inputs.push_back(input);
  }
  parts.skip("# options ").upTo('\n', study.options).upTo('\n', study.columns);
  if (parts.failed() || !are_words)
    throw std::invalid_argument("is not a part of a study: its head is damaged or truncated");
  if (study.group == 0 || part.items.begin > part.items.end || part.items.end > study.items) {
    throw std::invalid_argument("is not a part of a study: the item numbers in its head are impossible");
  }
  part.sound_bytes = parts.position();
  const std::uint64_t head_checksum = checksumOf(text.substr(0, part.sound_bytes));
  while (const std::optional<GroupInText> group = readGroup(parts, part, head_checksum)) {
    part.groups.push_back(*group);
    part.sound_bytes = parts.position();
  }
  requireOnce(part);
  return part;
}

std::vector<ItemRange> missingItems(const PartText& part) {
  std::vector<ItemRange> missing;
  std::size_t begin = part.items.begin;
  for (const ItemRange& items : answeredItems(part)) {
    if (begin < items.begin) missing.push_back({begin, items.begin});
    begin = items.end;
  }
  if (begin < part.items.end) missing.push_back({begin, part.items.end});
  return missing;
}

}  // namespace octoblisk::demos
