// The average cost of a query, besides its time.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "contender.h"

namespace octoblisk::bench {

/// The mean of the contender's own counts over poses or segments. Empty if it reports none.
template <typename Query, typename Question>
std::map<std::string, double> meanCost(const Query& query, const std::vector<Question>& questions) {
  std::map<std::string, double> mean;
  for (const Question& question : questions) {
    for (const auto& [name, count] : query.cost(question))
      mean[name] += count / static_cast<double>(questions.size());
  }
  return mean;
}

}  // namespace octoblisk::bench
