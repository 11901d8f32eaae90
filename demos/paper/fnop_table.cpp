#include "paper/fnop_table.h"

#include <utility>

namespace octoblisk::demos {

Table fnopTable(std::string name, std::string caption) {
  Table table{.name = std::move(name), .caption = std::move(caption), .columns = {"FNOP"}, .rows = {}};
  for (std::size_t column = 0; column < kFnops; ++column) {
    table.columns.push_back(std::to_string(fnopOf(column)));
  }
  return table;
}

void addRow(Table& table, const std::string& name,
            const std::function<std::string(std::size_t column)>& text) {
  table.rows.push_back({name});
  for (std::size_t column = 0; column < kFnops; ++column) table.rows.back().push_back(text(column));
}

Table oneRowPerMethod(std::string name, std::string caption,
                      const std::function<std::string(std::size_t method, std::size_t column)>& text) {
  Table table = fnopTable(std::move(name), std::move(caption));
  for (std::size_t method = 0; method < kMethods; ++method) {
    addRow(table, nameOfMethod(method), [&](std::size_t column) { return text(method, column); });
  }
  return table;
}

}  // namespace octoblisk::demos
