// Answers a study on all ranks of MPI: the first hands out and gathers, and answers too.
#pragma once

#include <functional>

#include "study/ranks.h"

namespace octoblisk::demos {

/// Ranks::answerAll for several ranks.
void answerTogether(Handout& handout, const AnswerItems& answer, const Ranks::Take& take,
                    const std::function<bool()>& stop);

}  // namespace octoblisk::demos
