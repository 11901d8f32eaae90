// Escapes text for HTML and XML.
#pragma once

#include <string>
#include <string_view>

namespace octoblisk::demos {

/// Escapes the characters that have a meaning in HTML and XML.
inline std::string markupText(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace octoblisk::demos
