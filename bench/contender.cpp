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
  const auto same = std::ranges::find(all, contender.name, &Contender::name);
  if (same != all.end()) {
    const auto add = [&](auto maker) {
      if (contender.*maker) *same.*maker = std::move(contender.*maker);
    };
    add(&Contender::collide);
    add(&Contender::contacts);
    add(&Contender::world_contacts);
    add(&Contender::world_step);
    add(&Contender::distance);
    add(&Contender::ray);
    add(&Contender::build);
    return true;
  }
  all.push_back(std::move(contender));
  std::ranges::sort(all, {}, [](const Contender& c) { return std::pair(c.name != kOurs, c.name); });
  return true;
}

}  // namespace octoblisk::bench
