// What a question takes on average, beside its time.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "contender.h"

namespace octoblisk::bench {

/// The contender's own counts, over the poses; empty where it does not tell.
inline std::map<std::string, double> meanCost(const PoseQuery& query, const std::vector<Pose>& poses) {
  std::map<std::string, double> mean;
  for (const Pose& pose : poses) {
    for (const auto& [name, count] : query.cost(pose))
      mean[name] += count / static_cast<double>(poses.size());
  }
  return mean;
}

}  // namespace octoblisk::bench
