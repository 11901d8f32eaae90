#include "report/markdown.h"
#include "report/results_page.h"

namespace octoblisk::bench {
namespace {

/// A line of the summary: our row and the other rows of its task and scene.
struct Line {
  const char* asked;
  const char* task;
  const char* scene;
};

constexpr Line kLines[] = {
    {"collision, along the path", "boolean-path", "300k"},
    {"the same, over all blades in random order", "boolean-shuffled", "300k"},
    {"collision, along the path on 1,500,000 triangles", "boolean-path", "1500k"},
    {"all triangle pairs that touch", "contacts", "300k"},
    {"distance at the clear poses", "distance-cold", "300k"},
    {"the same, starting from the previous pose", "distance-warm", "300k"},
    {"first hit of a ray", "ray", "300k"},
    {"build, each library on its own number of threads", "build", "300k"},
    {"refit, on one thread", "refit", "300k"},
    {"bytes per triangle", "memory", "300k"},
    {"Bullet world: contacts of belt and blisk", "world-contacts", "300k"},
    {"Bullet world: closest points", "world-closest", "300k"},
    {"Bullet world: contacts of a sphere with 500 triangles", "world-sphere", "500-triangles"},
    {"the same with 5,000 triangles", "world-sphere", "5000-triangles"},
    {"Bullet world: contacts of a box with 500 triangles", "world-box", "500-triangles"},
    {"the same with 5,000 triangles", "world-box", "5000-triangles"},
    {"Bullet world: contacts of a capsule with 500 triangles", "world-capsule", "500-triangles"},
    {"the same with 5,000 triangles", "world-capsule", "5000-triangles"},
    {"Bullet world: contacts of a cylinder with 500 triangles", "world-cylinder", "500-triangles"},
    {"the same with 5,000 triangles", "world-cylinder", "5000-triangles"},
    {"Bullet world: contacts of a hull with 500 triangles", "world-hull", "500-triangles"},
    {"the same with 5,000 triangles", "world-hull", "5000-triangles"},
    {"Bullet world: a ray", "world-ray", "300k"},
    {"Bullet world: a swept ball", "world-sweep", "300k"},
    {"Bullet world: a step with 200 hulls on the blisk", "world-step", "300k"},
    {"the same on 1,500,000 triangles", "world-step", "1500k"},
    {"the same with 1,000 hulls on 50,000 triangles", "world-step", "1000-bodies"},
    {"Bullet world: a step with 64 concave bodies", "world-pile", "64-bodies"},
    {"world: a step of a nut on a bolt", "world-assembly", "nut-on-bolt"},
    {"all triangle pairs of the nut and the bolt that touch", "assembly-contacts", "nut-on-bolt"},
};

constexpr const char* kOnOneThread = "OctoBlisk on one thread";
constexpr const char* kShape = "OctoBlisk's shape";

/// A contender's name in the summary. Empty for a variant of ours that the summary leaves out.
std::string calledIn(const std::string& contender) {
  const std::pair<const char*, const char*> names[] = {{"fcl", "FCL"},
                                                       {"fcl-points", "FCL with points"},
                                                       {"ode", "ODE"},
                                                       {"embree", "Embree"},
                                                       {"cgal", "CGAL"},
                                                       {"bullet-bvh", "BVH"},
                                                       {"bvh-gimpact", "BVH with a GImpact belt"},
                                                       {"scaled-bvh", "scaled BVH"},
                                                       {"gimpact", "GImpact"},
                                                       {"octoblisk-1-thread", kOnOneThread},
                                                       {"octoblisk-shape", kShape}};
  for (const auto& [name, called] : names) {
    if (contender == name) return called;
  }
  return contender.starts_with("octoblisk") ? "" : contender;
}

std::string tableOf(const Rows& rows) {
  MarkdownTable table({"query", "OctoBlisk", "others, relative to OctoBlisk"});
  for (const Line& line : kLines) {
    const Row* ours = findRow(rows, line.task, line.scene, kOurs);
    if (ours == nullptr) continue;
    std::string others;
    for (const Row& row : rows) {
      if (row["task"] != line.task || row["scene"] != line.scene || !row["ratio"].is_number()) continue;
      const std::string name = calledIn(row.value("contender", ""));
      if (name.empty() || &row == ours) continue;
      if (name == kOnOneThread && line.task != std::string("build")) continue;
      const double ratio = row["ratio"].get<double>();
      const std::string text = name + ' ' + significant(ratio);
      others += (others.empty() ? "" : ", ") + (isFaster(ratio) ? "**" + text + "**" : text);
      if (row.value("differences", 0) > 0) others += '*';
    }
    const char* wrong = ours->value("differences", 0) > 0 ? "*" : "";
    const bool is_memory = ours->contains("bytes_a_triangle");
    table.add({line.asked,
               (is_memory ? significant((*ours)["bytes_a_triangle"].get<double>())
                          : timeText((*ours)["mean_us"].get<double>())) +
                   wrong,
               others});
  }
  return table.text();
}

std::string plotsOf(const Rows& rows, const std::string& results) {
  MarkdownTable table({"", ""});
  std::vector<std::string> line;
  for (const auto& [file, plot] : resultsPage(rows, Row()).plots) {
    line.push_back("![" + plot.title + ", by " + plot.x_label + "](" + results + '/' + file + ')');
    if (line.size() < 2) continue;
    table.add(line);
    line.clear();
  }
  if (!line.empty()) table.add({line.front(), ""});
  return table.empty() ? "" : '\n' + table.text();
}

}  // namespace

std::string summary(const Rows& rows, const std::string& results) {
  return tableOf(rows) + plotsOf(rows, results);
}

}  // namespace octoblisk::bench
