#include "paper/method_table.h"

#include <algorithm>

namespace octoblisk::demos {

std::string nameOfMethod(std::size_t method) {
  return method == 0 ? "traditional" : "k = " + std::to_string(clustersOfMethod(method));
}

bool canBeNodeCount(int nodes, std::size_t k) {
  const int roots = static_cast<int>(std::max<std::size_t>(k, 1));
  return nodes >= roots && (nodes - roots) % 8 == 0;
}

}  // namespace octoblisk::demos
