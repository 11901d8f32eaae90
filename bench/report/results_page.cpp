#include "report/results_page.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "report/markdown.h"
#include "report/power_law.h"

namespace octoblisk::bench {
namespace {

Rows ofTask(const Rows& rows, const std::string& task) {
  Rows its;
  std::ranges::copy_if(rows, std::back_inserter(its), [&](const Row& row) { return row["task"] == task; });
  return its;
}

/// The different values of a key, in the order of the rows.
std::vector<std::string> valuesOf(const Rows& rows, const char* key) {
  std::vector<std::string> values;
  for (const Row& row : rows) {
    const std::string value = row.value(key, "");
    if (std::ranges::find(values, value) == values.end()) values.push_back(value);
  }
  return values;
}

double number(const Row& row, const char* key) {
  return row.contains(key) && row[key].is_number() ? row[key].get<double>() : 0.0;
}

std::string ratioText(const Row& row) {
  const double ratio = number(row, "ratio");
  if (ratio == 0.0) return "";
  const std::string text = significant(ratio, ratio >= 99.5 ? 3 : 2);
  return isFaster(ratio) && row.value("contender", "") != kOurs ? std::string("**") + text + "**" : text;
}

std::string differencesText(const Row& row) {
  const double differences = number(row, "differences");
  if (differences == 0.0) return "";
  return std::string(" (") + std::to_string(std::llround(differences)) + " differ)";
}

std::string partText(double part, double all) {
  return std::to_string(std::llround(part)) + " of " + std::to_string(std::llround(all));
}

std::string cellOf(const Row& row) {
  std::string text = row.contains("bytes_a_triangle") ? significant(number(row, "bytes_a_triangle")) + " B"
                                                      : timeText(number(row, "mean_us"));
  const std::string ratio = ratioText(row);
  if (!ratio.empty() && row.value("contender", "") != kOurs) text += std::string(" · ") + ratio;
  for (const auto& [key, what] :
       {std::pair("points_a_pose", "points per pose"), std::pair("contacts_a_step", "contacts per step"),
        std::pair("inside", "in the blisk at the end"), std::pair("off_helix_mm", "mm off the helix"),
        std::pair("turns", "turns")}) {
    if (row.contains(key)) text += std::string(", ") + significant(number(row, key)) + ' ' + what;
  }
  return text + differencesText(row);
}

/// A task and its title.
struct Section {
  const char* task;
  const char* asks;
};

constexpr Section kSections[] = {
    {"boolean-path", "Collision, pose by pose along the path"},
    {"boolean-shuffled", "Collision at the same poses, over all blades in random order"},
    {"contacts", "All triangle pairs that touch"},
    {"distance-cold", "Distance at the clear poses, each independently"},
    {"distance-warm", "Distance, starting from the result at the previous pose"},
    {"ray", "The first triangle that a ray hits"},
    {"build", "Build over the blisk, each library on its own number of threads"},
    {"refit", "Refit to moved vertices"},
    {"memory", "Bytes per triangle in addition to the mesh"},
    {"world-contacts", "Bullet world: contact points of blisk and belt (contactPairTest)"},
    {"world-closest", "Bullet world: closest points within 1 mm (contactPairTest with a threshold)"},
    {"world-sphere", "Bullet world: contacts of a sphere and a small mesh (contactPairTest)"},
    {"world-box", "Bullet world: contacts of a box and a small mesh (contactPairTest)"},
    {"world-capsule", "Bullet world: contacts of a capsule and a small mesh (contactPairTest)"},
    {"world-cylinder", "Bullet world: contacts of a cylinder and a small mesh (contactPairTest)"},
    {"world-hull", "Bullet world: contacts of a convex hull and a small mesh (contactPairTest)"},
    {"world-ray", "Bullet world: rayTest"},
    {"world-sweep", "Bullet world: convexSweepTest of a ball of 3 mm"},
    {"world-step", "Bullet world: a step in which hulls fall onto the blisk"},
    {"world-pile", "Bullet world: a step of 64 concave bodies on each other"},
    {"world-assembly", "World of Bullet or ODE: a step of a nut that runs down a bolt"},
    {"assembly-contacts", "All triangle pairs of the nut and the bolt that touch"},
    {"broadphase-world", "Bullet world: a step of the grinding world, by broadphase"},
};

const Growth kGrowths[] = {
    {"growth-boolean", "", "collision, along the path", "triangles of the blisk"},
    {"growth-boolean", "belt", "collision, along the path", "triangles of the belt"},
    {"growth-distance", "", "distance, each pose independently", "triangles of the blisk"},
    {"growth-distance", "belt", "distance, each pose independently", "triangles of the belt"},
    {"growth-ray", "", "the first triangle that a ray hits", "triangles of the blisk"},
    {"growth-build", "", "building, on one core", "triangles of the blisk"},
    {"growth-bodies", "", "a step of a Bullet world", "bodies that fall onto the blisk"},
};

std::string machineText(const Rows& rows, const Row& context) {
  std::string text;
  for (const std::string& commit : valuesOf(rows, "commit"))
    if (!commit.empty()) text += "- commit: " + commit + '\n';
  if (!context.is_object()) return text;
  const auto item = [&](const std::string& name, const char* key) {
    if (!context.contains(key)) return;
    const Row& value = context[key];
    text += std::string("- ") + name + ": " + (value.is_string() ? value.get<std::string>() : value.dump()) +
            '\n';
  };
  item("date", "date");
  item("processor", "processor");
  item("cores", "num_cpus");
  item("MHz, as reported by the system", "mhz_per_cpu");
  item("pinned to core", "pinned_to_core");
  item("compiler and flags", "octoblisk_flags");
  item("other libraries", "peers");
  for (const auto& [key, value] : context.items()) {
    const std::string prefix = "contender ";
    if (key.starts_with(prefix))
      text += std::string("- ") + key.substr(prefix.size()) + ": " + value.get<std::string>() + '\n';
  }
  return text + '\n';
}

/// When all bodies were asleep; of several runs the median, the least and the most.
std::string sleepText(const Row& row) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::vector<double> steps;
  for (const Row& after : row["asleep_after_steps"])
    steps.push_back(after.is_null() ? kNever : after.get<double>());
  std::ranges::sort(steps);
  const auto text = [](double after) {
    return after == kNever ? "never" : std::to_string(std::llround(after));
  };
  if (steps.front() == kNever)
    return "never (" + partText(number(row, "asleep"), number(row, "bodies")) + ")";
  const std::string median = text(steps[steps.size() / 2]);
  if (steps.size() == 1) return median;
  return median + " (" + text(steps.front()) + " to " + text(steps.back()) + ")";
}

}  // namespace

std::string taskTable(const Rows& all, const std::string& task) {
  const Rows rows = ofTask(all, task);
  if (rows.empty()) return "";
  const std::vector<std::string> scenes = valuesOf(rows, "scene");
  std::vector<std::string> header = {"contender"};
  header.insert(header.end(), scenes.begin(), scenes.end());
  MarkdownTable table(header);
  for (const std::string& contender : valuesOf(rows, "contender")) {
    std::vector<std::string> cells = {contender};
    for (const std::string& scene : scenes) {
      const Row* row = findRow(rows, task, scene, contender);
      cells.push_back(row ? cellOf(*row) : std::string());
    }
    table.add(cells);
  }
  return table.text();
}

LogLogPlot growthPlot(const Rows& all, const Growth& growth) {
  LogLogPlot plot{.title = growth.title, .x_label = growth.x_label, .y_label = "µs"};
  Rows rows = ofTask(all, growth.task);
  std::erase_if(rows, [&](const Row& row) {
    return row.value("scene", "").starts_with("belt") != (growth.prefix == "belt") ||
           number(row, "size") <= 0.0;
  });
  std::ranges::stable_sort(rows, {}, [](const Row& row) { return number(row, "size"); });
  for (const std::string& contender : valuesOf(rows, "contender")) {
    Curve curve{.name = contender};
    bool has_wrong = false;
    for (const Row& row : rows) {
      if (row.value("contender", "") != contender) continue;
      curve.x.push_back(number(row, "size"));
      curve.y.push_back(number(row, "mean_us"));
      has_wrong |= row.value("differences", 0) > 0;
    }
    if (has_wrong) curve.name += '*';
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

std::string growthTable(const LogLogPlot& plot) {
  MarkdownTable table({"contender", "least number", "greatest number", "time at the least",
                       "time at the greatest", "exponent"});
  for (const Curve& curve : plot.curves) {
    const bool has_law = curve.x.size() > 1 && curve.x.front() != curve.x.back();
    table.add({curve.name, significant(curve.x.front()), significant(curve.x.back()),
               timeText(curve.y.front()), timeText(curve.y.back()),
               has_law ? significant(fitPowerLaw(curve.x, curve.y).exponent) : std::string()});
  }
  return table.empty() ? "" : table.text();
}

std::string ablationTable(const Rows& all) {
  const char* const queries[] = {"boolean", "contacts", "distance", "ray"};
  Rows rows;
  for (const char* query : queries) {
    for (Row& row : ofTask(all, std::string("ablation-") + query)) rows.push_back(std::move(row));
  }
  if (rows.empty()) return "";
  MarkdownTable table({"variant", "collision", "all pairs", "distance", "ray"});
  const std::string scene = rows.front()["scene"].get<std::string>();
  for (const std::string& variant : valuesOf(rows, "contender")) {
    std::vector<std::string> cells = {variant};
    for (const char* query : queries) {
      const Row* row = findRow(rows, std::string("ablation-") + query, scene, variant);
      if (row == nullptr) {
        cells.emplace_back();
      } else {
        cells.push_back((variant == kOurs ? timeText(number(*row, "mean_us")) : ratioText(*row)) +
                        differencesText(*row));
      }
    }
    table.add(cells);
  }
  return table.text();
}

std::string limitTable(const Rows& all) {
  MarkdownTable table({"query", "blisk", "OctoBlisk", "lower bound", "ratio", "exact tests of the bound",
                       "exact tests made", "bytes of the bound", "bytes read"});
  for (const char* query : {"boolean", "contacts", "distance", "ray"}) {
    const std::string task = std::string("limit-") + query;
    for (const std::string& scene : valuesOf(ofTask(all, task), "scene")) {
      const Row *ours = findRow(all, task, scene, kOurs), *bound = findRow(all, task, scene, "lower-bound");
      if (!ours || !bound) continue;
      table.add({query, scene, timeText(number(*ours, "mean_us")), timeText(number(*bound, "mean_us")),
                 significant(number(*ours, "mean_us") / number(*bound, "mean_us")),
                 significant(number(*bound, "exact_tests")), significant(number(*ours, "exact_tests")),
                 significant(number(*bound, "bytes")), significant(number(*ours, "bytes"))});
    }
  }
  return table.empty() ? "" : table.text();
}

std::string paperTable(const Rows& all) {
  const Rows rows = ofTask(all, "paper-method");
  if (rows.empty()) return "";
  MarkdownTable table({"blisk", "method", "time per pose", "ratio", "range, mm³", "leaves left",
                       "volume left, mm³", "false alarms", "missed"});
  for (const Row& row : rows) {
    const double clear = number(row, "clear_poses"), poses = number(row, "questions");
    const bool of_boxes = row.value("contender", "") != kOurs;
    table.add({row["scene"].get<std::string>(), row.value("contender", ""), timeText(number(row, "mean_us")),
               ratioText(row), significant(number(row, "range_mm3"), 3),
               of_boxes ? significant(number(row, "leaves_left")) : "",
               of_boxes ? significant(number(row, "volume_left_mm3")) : "",
               partText(number(row, "false_alarms"), clear), partText(number(row, "missed"), poses - clear)});
  }
  return table.text();
}

std::string dynamicsTable(const Rows& all) {
  MarkdownTable table({"scene", "shape", "time per step", "time per step until all sleep",
                       "steps until all sleep", "late kinetic energy, J", "depth, mm", "points", "manifolds",
                       "lost", "further figures"});
  for (const Row& row : ofTask(all, "dynamics")) {
    std::string beside;
    const Row figures = row.value("figures", Row::object());  // items() refers to it
    for (const auto& [name, value] : figures.items())
      beside += (beside.empty() ? "" : ", ") + name + ' ' + significant(value.get<double>(), 3);
    const auto countText = [&](const char* key) { return std::to_string(std::llround(number(row, key))); };
    table.add({row["scene"].get<std::string>(), row.value("contender", ""),
               timeText(1e3 * number(row, "step_ms")), timeText(1e3 * number(row, "awake_step_ms")),
               sleepText(row), significant(number(row, "late_energy_j")),
               significant(1e3 * number(row, "depth_m")), countText("points"), countText("manifolds"),
               countText("lost"), beside});
  }
  return table.empty() ? "" : table.text();
}

std::string lostTable(const Rows& rows) {
  MarkdownTable table(
      {"task", "scene", "faster", "ratio", "boxes", "leaf pairs", "triangle tests", "exact tests", "bytes"});
  std::vector<std::string> tasks;
  for (const Section& section : kSections) tasks.emplace_back(section.task);
  for (const Growth& growth : kGrowths) {
    if (std::ranges::find(tasks, growth.task) == tasks.end()) tasks.push_back(growth.task);
  }
  for (const std::string& task : tasks) {
    for (const Row& row : ofTask(rows, task)) {
      const std::string contender = row.value("contender", "");
      const double ratio = number(row, "ratio");
      if (contender.starts_with(kOurs) || ratio == 0.0 || !isFaster(ratio)) continue;
      const Row* ours = findRow(rows, task, row["scene"].get<std::string>(), kOurs);
      if (ours == nullptr) continue;
      const auto count = [&](const char* key) {
        return ours->contains(key) ? significant(number(*ours, key)) : std::string();
      };
      table.add({task, row["scene"].get<std::string>(), contender + differencesText(row), significant(ratio),
                 count("box_tests"), count("leaf_pairs"), count("triangle_tests"), count("exact_tests"),
                 count("bytes")});
    }
  }
  return table.empty() ? "" : table.text();
}

TimePlot dynamicsPlot(const Rows& all, const std::string& scene) {
  TimePlot plot{.title = scene, .panels = {{"kinetic energy, J", 1e-6}, {"greatest depth, m", 1e-5}}};
  for (const Row& row : ofTask(all, "dynamics")) {
    if (row["scene"] != scene) continue;
    plot.title = row.value("shows", scene);
    const std::string name = row.value("contender", "");
    plot.panels[0].curves.push_back({name, row["time_s"], row["energy_j"]});
    plot.panels[1].curves.push_back({name, row["time_s"], row["depth_over_time_m"]});
  }
  return plot;
}

ResultsPage resultsPage(const Rows& rows, const Row& context) {
  ResultsPage page;
  std::string& text = page.text;
  text =
      "# Results\n\n"
      "`./dev bench` writes this page from the rows in this folder; `../README.md` explains them.\n"
      "A cell has the mean time of a query and, after ·, its ratio to that of OctoBlisk in the same run.\n"
      "The ratio is bold if the contender is faster. The number in brackets counts the answers that differ\n"
      "from the reference. In the sections on growth, * marks a contender with such answers.\n\n"
      "## Machine\n\n" +
      machineText(rows, context);
  const auto section = [&](const std::string& title, const std::string& table) {
    if (!table.empty()) text += std::string("## ") + title + "\n\n" + table + '\n';
  };
  section("Rows in which another library is faster, and what a query of ours costs there", lostTable(rows));
  for (const auto& [task, asks] : kSections)
    section(std::string(asks) + " (`" + task + "`)", taskTable(rows, task));
  section("The paper's method (`paper-method`)", paperTable(rows));
  for (const Growth& growth : kGrowths) {
    const LogLogPlot plot = growthPlot(rows, growth);
    if (plot.curves.empty()) continue;
    const std::string file =
        growth.task + (growth.prefix.empty() ? std::string() : std::string("-") + growth.prefix) + ".svg";
    section(
        std::string("Growth with the ") + growth.x_label + ": " + growth.title + " (`" + growth.task + "`)",
        std::string("![](") + file + ")\n\n" + growthTable(plot));
    page.plots.push_back({file, plot});
  }
  std::string pictures;
  for (const std::string& scene : valuesOf(ofTask(rows, "dynamics"), "scene")) {
    const std::string file = "dynamics-" + scene + ".svg";
    pictures += "\n![" + scene + "](" + file + ")\n";
    page.time_plots.push_back({file, dynamicsPlot(rows, scene)});
  }
  if (!pictures.empty()) section("Dynamics (`dynamics`)", dynamicsTable(rows) + pictures);
  section("Variants: time relative to the default (`ablation`)", ablationTable(rows));
  section("Lower bounds (`limit`)", limitTable(rows));
  return page;
}

}  // namespace octoblisk::bench
