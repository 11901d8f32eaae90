// A study with a known table: each item has none to two rows with its square.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "study/run_study.h"
#include "study/study.h"

namespace octoblisk::demos {

inline Study squaresStudy(std::size_t items) {
  Study study;
  study.name = "squares";
  study.columns = "item,row,square";
  study.items = items;
  study.group = 4;
  study.inputs = {{"numbers", 1}, {"rules", 2}};
  study.options = "none";
  return study;
}

inline std::string squaresRows(ItemRange items) {
  std::string rows;
  for (std::size_t item = items.begin; item < items.end; ++item) {
    for (std::size_t row = 0; row < item % 3; ++row) {
      rows += std::to_string(item) + ',' + std::to_string(row) + ',' + std::to_string(item * item) + '\n';
    }
  }
  return rows;
}

inline std::string squaresTable(std::size_t items) { return "item,row,square\n" + squaresRows({0, items}); }

inline std::vector<AnsweredGroup> squaresOf(ItemRange items, std::size_t group = 4) {
  std::vector<AnsweredGroup> groups;
  for (std::size_t begin = items.begin; begin < items.end; begin += group) {
    const ItemRange of_group = {begin, std::min(items.end, begin + group)};
    groups.push_back({of_group, squaresRows(of_group), std::to_string(of_group.size()) + " items"});
  }
  return groups;
}

}  // namespace octoblisk::demos
