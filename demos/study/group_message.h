// Messages with answers between processes of the same program.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "study/study.h"

namespace octoblisk::demos {

struct GroupMessage {
  std::vector<AnsweredGroup> groups;
  std::chrono::duration<double> time{};  ///< time to find them
};

std::string packed(const GroupMessage& message);

/// Throws std::invalid_argument for text that packed() did not return.
GroupMessage unpacked(std::string_view text);

}  // namespace octoblisk::demos
