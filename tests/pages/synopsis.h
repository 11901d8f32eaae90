// The calls that a synopsis allows, for example `make arm|belt --out FILE [--width MM]`.
#pragma once

#include <string>
#include <vector>

namespace octoblisk::pages {

/// A word in capitals or an ellipsis, and its value. The value may apply only after a certain option.
struct Placeholder {
  std::string option;  ///< e.g. "--belt"; empty: any
  std::string word;    ///< e.g. "FILE"
  std::string value;
};

/// The synopses of a block. A synopsis begins with the command's name, at the start of a line or after a
/// comma.
std::vector<std::string> synopsesOf(const std::string& block, const std::string& command);

/// Calls with everything in brackets, enough to use each alternative once. Throws std::invalid_argument if a
/// bracket is not closed or a placeholder has no value.
std::vector<std::string> fullCalls(const std::string& synopsis, const std::vector<Placeholder>& placeholders);

/// The call with nothing in brackets and with the first of all alternatives.
std::string leastCall(const std::string& synopsis, const std::vector<Placeholder>& placeholders);

}  // namespace octoblisk::pages
