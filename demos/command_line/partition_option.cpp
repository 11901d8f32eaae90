#include "command_line/partition_option.h"

#include <CLI/CLI.hpp>
#include <regex>
#include <string>

#include "io/quoted_text.h"

namespace octoblisk::demos {

void addPartitionOption(CLI::App& command, BuildOptions& options) {
  const auto read = [&options](const std::string& text) {
    static const std::regex form("paper(?::([1-8])(?::([1-9][0-9]{0,5}))?)?");
    std::smatch found;
    if (text == "clustered") {
      options.partition = PartitionKind::clustering;
      return;
    }
    if (!std::regex_match(text, found, form)) {
      throw CLI::ValidationError("--partition",
                                 inQuotes(text) + " is not clustered or paper[:K[:FNOP]], K 1 to 8");
    }
    options.partition = PartitionKind::paper;
    options.clusters = found[1].matched ? std::stoi(found[1]) : 0;
    if (found[2].matched) options.leaf_capacity = std::stoi(found[2]);
  };
  command
      .add_option_function<std::string>("--partition", read,
                                        "How trees divide triangles: clustered, or the paper's "
                                        "paper[:K[:FNOP]], K clusters a part (a blade), "
                                        "each by an octree of FNOP triangles a leaf; without K the best of 2 "
                                        "to 8, FNOP 8. The verdicts are "
                                        "the same")
      ->type_name("PARTITION");
}

}  // namespace octoblisk::demos
