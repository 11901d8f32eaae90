#include "study/launch.h"

#include <charconv>
#include <cstdlib>
#include <string_view>

namespace octoblisk::demos {
namespace {

/// The variable's whole number, or -1.
int numberIn(const char* variable) {
  const char* const value = std::getenv(variable);
  if (value == nullptr) return -1;
  const std::string_view text(value);
  int number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && stop == text.data() + text.size() && number >= 0 ? number : -1;
}

}  // namespace

Launch launchedAs() {
  // PMIX_RANK is optional here: Slurm sets its own numbers too.
  constexpr const char* kVariables[][3] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", nullptr},
                                           {"PMI_RANK", "PMI_SIZE", nullptr},
                                           {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS", "PMIX_RANK"}};
  for (const auto& [rank_variable, count_variable, beside] : kVariables) {
    const int rank = numberIn(rank_variable), count = numberIn(count_variable);
    if (count > 1 && rank >= 0 && rank < count && (beside == nullptr || numberIn(beside) >= 0)) {
      return {rank, count};
    }
  }
  return {};
}

}  // namespace octoblisk::demos
