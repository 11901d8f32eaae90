// Text as HTML and XML show it.
#pragma once

#include <string>
#include <string_view>

namespace octoblisk::demos {

/// With what means something in HTML and XML escaped.
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
