// Measures energy, depth and cost of moving bodies, for each scene and shape.
//
//   dynamics [--quick] [--only SCENE,...] [rows = dynamics.json]
//
// Prints one line for each run and writes the rows. The file's rows of other scenes stay. --quick uses fewer
// bodies and steps, to check that everything works.
#include <algorithm>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "dynamics/measure.h"
#include "dynamics/scenes.h"

namespace octoblisk::bench {
namespace {

struct Options {
  bool quick = false;
  std::vector<std::string> only;  ///< empty: all
  std::string file = "dynamics.json";
};

Options optionsOf(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--quick") {
      options.quick = true;
    } else if (argument == "--only" && i + 1 < argc) {
      std::istringstream names(argv[++i]);
      for (std::string name; std::getline(names, name, ',');) options.only.push_back(name);
    } else if (argument.starts_with("-")) {
      throw std::runtime_error("usage: dynamics [--quick] [--only SCENE,...] [rows]");
    } else {
      options.file = argument;
    }
  }
  for (const std::string& name : options.only) {
    if (std::ranges::find(dynamicsEntries(), name, &DynamicsEntry::name) == dynamicsEntries().end())
      throw std::runtime_error("unknown scene '" + name + "'");
  }
  return options;
}

void run(const Options& options) {
  for (const DynamicsEntry& entry : dynamicsEntries()) {
    if (!options.only.empty() && std::ranges::find(options.only, entry.name) == options.only.end()) continue;
    const DynamicsSize size = options.quick ? entry.quick : entry.full;
    Rows rows;
    for (const ShapeKind kind : entry.kinds) {
      const auto scene = entry.make(kind, size.bodies);
      Row row = {
          {"task", "dynamics"}, {"scene", entry.name}, {"contender", nameOf(kind)}, {"shows", entry.shows}};
      row.update(measured(*scene, size.steps));
      const Row first = row["asleep_after_steps"];
      Row& sleeps = row["asleep_after_steps"] = Row::array({first});
      if (!options.quick && entry.is_chaotic) {
        for (int more = -8; more <= 8; ++more) {
          if (more != 0)
            sleeps.push_back(stepsUntilAsleep(*entry.make(kind, size.bodies + more), size.steps));
        }
      }
      std::printf(
          "%-15s %-10s %8.2f ms per step, asleep after %s, late %.3g J, depth %.3g m, %d points in %d, "
          "lost %d %s\n",
          entry.name.c_str(), nameOf(kind), row["step_ms"].get<double>(), sleeps.dump().c_str(),
          row["late_energy_j"].get<double>(), row["depth_m"].get<double>(), row["points"].get<int>(),
          row["manifolds"].get<int>(), row["lost"].get<int>(), row["figures"].dump().c_str());
      std::fflush(stdout);
      rows.push_back(std::move(row));
    }
    addRows(options.file, rows);
  }
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  try {
    octoblisk::bench::run(octoblisk::bench::optionsOf(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dynamics: %s\n", error.what());
    return 2;
  }
}
