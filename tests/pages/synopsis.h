// What a line that tells how a command is called, as `make arm|belt --out FILE [--width MM]`, allows.
#pragma once

#include <string>
#include <vector>

namespace octoblisk::pages {

/// A word in capitals or an ellipsis, and what stands for it: by the option before it where that is named.
struct Placeholder {
  std::string option;  ///< e.g. "--belt"; empty: any
  std::string word;    ///< e.g. "FILE"
  std::string value;
};

/// The synopses of a block: one begins where a line does with the command's name, or behind a comma with it.
std::vector<std::string> synopsesOf(const std::string& block, const std::string& command);

/// Calls with all that is in brackets, so many that each alternative is in one of them.
/// Throws std::invalid_argument on a bracket that is not closed, and a placeholder without a value.
std::vector<std::string> fullCalls(const std::string& synopsis, const std::vector<Placeholder>& placeholders);

/// The call with nothing that is in brackets, and the first of all alternatives.
std::string leastCall(const std::string& synopsis, const std::vector<Placeholder>& placeholders);

}  // namespace octoblisk::pages
