// Makes text of a user's file or command line safe to show in a message.
#pragma once

#include <string>
#include <string_view>

namespace octoblisk::demos {

/// The text in single quotes. Bytes that are not printable ASCII become '?', and anything beyond 60 bytes is
/// cut off: the bytes of a binary file must not reach a terminal.
inline std::string inQuotes(std::string_view text) {
  constexpr std::size_t kMaxBytes = 60;
  std::string shown = "'";
  for (const char letter : text.substr(0, kMaxBytes)) {
    shown += letter >= ' ' && letter <= '~' ? letter : '?';
  }
  return shown + (text.size() > kMaxBytes ? "...'" : "'");
}

}  // namespace octoblisk::demos
