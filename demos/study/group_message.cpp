#include "study/group_message.h"

#include <cstring>
#include <stdexcept>

namespace octoblisk::demos {
namespace {

template <typename Number>
void appendNumber(std::string& text, Number number) {
  char bytes[sizeof(Number)];
  std::memcpy(bytes, &number, sizeof(Number));
  text.append(bytes, sizeof(Number));
}

std::string_view takeBytes(std::string_view& text, std::size_t count) {
  if (text.size() < count) throw std::invalid_argument("a message between processes is truncated");
  const std::string_view taken = text.substr(0, count);
  text.remove_prefix(count);
  return taken;
}

template <typename Number>
Number takeNumber(std::string_view& text) {
  Number number;
  std::memcpy(&number, takeBytes(text, sizeof(Number)).data(), sizeof(Number));
  return number;
}

}  // namespace

std::string packed(const GroupMessage& message) {
  std::string text;
  appendNumber(text, message.time.count());
  for (const AnsweredGroup& group : message.groups) {
    for (const std::size_t number :
         {group.items.begin, group.items.end, group.rows.size(), group.tally.size()}) {
      appendNumber(text, number);
    }
    text += group.rows + group.tally;
  }
  return text;
}

GroupMessage unpacked(std::string_view text) {
  GroupMessage message;
  message.time = std::chrono::duration<double>(takeNumber<double>(text));
  while (!text.empty()) {
    AnsweredGroup& group = message.groups.emplace_back();
    group.items.begin = takeNumber<std::size_t>(text);
    group.items.end = takeNumber<std::size_t>(text);
    const auto rows = takeNumber<std::size_t>(text);
    const auto tally = takeNumber<std::size_t>(text);
    group.rows = takeBytes(text, rows);
    group.tally = takeBytes(text, tally);
  }
  return message;
}

}  // namespace octoblisk::demos
