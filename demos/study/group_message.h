// Answers on their way from one process to another of the same program.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "study/study.h"

namespace octoblisk::demos {

struct GroupMessage {
  std::vector<AnsweredGroup> groups;
  std::chrono::duration<double> time{};  ///< that they took
};

std::string packed(const GroupMessage& message);

/// Throws std::invalid_argument where it is not what packed() returned.
GroupMessage unpacked(std::string_view text);

}  // namespace octoblisk::demos
