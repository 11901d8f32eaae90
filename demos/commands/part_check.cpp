#include "commands/part_check.h"

#include <stdexcept>
#include <string>

#include "access/access_summary.h"
#include "commands/access_files.h"
#include "commands/check_summary.h"
#include "io/quoted_text.h"

namespace octoblisk::demos {
namespace {

/// The other files of access are made from the finished table, when it is too late to refuse a row.
void requireAccessRows(const GroupInText& group, std::string_view rows) {
  std::size_t count = 0;
  for (; !rows.empty(); ++count) {
    const std::size_t end = rows.find('\n');
    if (end == std::string_view::npos) {
      throw std::invalid_argument("has an incomplete row: " + inQuotes(rows));
    }
    rowOfLine(rows.substr(0, end));
    rows.remove_prefix(end + 1);
  }
  if (count != group.items.size()) {
    throw std::invalid_argument("has " + std::to_string(count) + " rows for " +
                                std::to_string(group.items.size()) + " points");
  }
}

}  // namespace

void checkPart(const PartText& part, std::string_view text) {
  const Study& study = part.study;
  if (study.name == kCheckName) {
    optionsOfLine(study.options);
    for (const GroupInText& group : part.groups) summaryOfTally(group.tally);
  }
  if (study.name == kAccessName) {
    questionOfLine(study.options);
    if (study.columns != accessColumns()) {
      throw std::invalid_argument("has columns that are not from an accessibility map: " +
                                  inQuotes(study.columns));
    }
    for (const GroupInText& group : part.groups) {
      accessSummaryOfTally(group.tally);
      requireAccessRows(group, text.substr(group.begin, group.bytes));
    }
  }
}

}  // namespace octoblisk::demos
