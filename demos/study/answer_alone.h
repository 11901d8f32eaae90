// Answers a study in a single process.
#pragma once

#include <chrono>

#include "study/ranks.h"

namespace octoblisk::demos {

inline void answerAlone(Handout& handout, const AnswerItems& answer, const Ranks::Take& take,
                        const std::function<bool()>& stop) {
  Pace pace;
  while (!stop()) {
    const ItemRange items = handout.next(pace.groups());
    if (items.empty()) return;
    const auto start = std::chrono::steady_clock::now();
    take(answer(items));
    pace.took(std::chrono::steady_clock::now() - start);
  }
}

}  // namespace octoblisk::demos
