#include "contender.h"

#include <algorithm>
#include <utility>

namespace octoblisk::bench {
namespace {

std::vector<Contender>& registered() {
  static std::vector<Contender> all;
  return all;
}

}  // namespace

const std::vector<Contender>& contenders() { return registered(); }

bool registerContender(Contender contender) {
  std::vector<Contender>& all = registered();
  all.push_back(std::move(contender));
  std::ranges::sort(all, {}, [](const Contender& c) { return std::pair(c.name != kOurs, c.name); });
  return true;
}

}  // namespace octoblisk::bench
