#include "contender.h"

#include <algorithm>
#include <utility>

namespace octoblisk::bench {
namespace {

std::vector<Contender>& registered(const std::string& group) {
  static std::map<std::string, std::vector<Contender>> groups;
  return groups[group];
}

std::vector<std::pair<std::string, std::string>>& described() {
  static std::vector<std::pair<std::string, std::string>> all;
  return all;
}

}  // namespace

const std::vector<Contender>& contenders(const std::string& group) { return registered(group); }

bool registerContender(Contender contender) {
  std::vector<Contender>& all = registered(contender.group);
  const auto same = std::ranges::find(all, contender.name, &Contender::name);
  if (same != all.end()) {
    forEachMaker([&](auto maker) {
      if (contender.*maker) *same.*maker = std::move(contender.*maker);
    });
    return true;
  }
  all.push_back(std::move(contender));
  std::ranges::sort(all, {}, [](const Contender& c) { return std::pair(c.name != kOurs, c.name); });
  return true;
}

bool describe(const std::string& name, const std::string& about) {
  described().emplace_back(name, about);
  return true;
}

const std::vector<std::pair<std::string, std::string>>& descriptions() { return described(); }

}  // namespace octoblisk::bench
