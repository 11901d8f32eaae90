#include "report/markdown.h"
#include "report/results_page.h"

namespace octoblisk::bench {
namespace {

/// A line of the summary: a row of ours, and the contenders it is told beside.
struct Line {
  const char* asked;
  const char* task;
  const char* scene;
  std::vector<std::pair<const char*, const char*>> peers;  // contender, and what it is called
};

const Line kLines[] = {
    {"touching or not, along the path",
     "boolean-path",
     "300k",
     {{"fcl", "FCL"}, {"ode", "ODE"}, {"embree", "Embree"}}},
    {"the same over all blades in random order", "boolean-shuffled", "300k", {{"fcl", "FCL"}}},
    {"the same on 1,500,000 triangles", "boolean-path", "1500k", {{"fcl", "FCL"}}},
    {"all pairs of triangles that touch", "contacts", "300k", {{"fcl", "FCL"}, {"bullet-bvh", "BVH"}}},
    {"distance of clear poses", "distance-cold", "300k", {{"fcl", "FCL"}}},
    {"the same from the pose before", "distance-warm", "300k", {{"fcl", "FCL"}}},
    {"closest ray", "ray", "300k", {{"bullet-bvh", "BVH"}, {"embree", "Embree"}}},
    {"build, on two threads", "build", "300k", {{"bullet-bvh", "BVH"},
      {"gimpact", "GImpact"},
      {"embree", "Embree"},
      {"cgal", "CGAL"},
      {"fcl", "FCL"}}},
    {"refit, on one", "refit", "300k", {{"bullet-bvh", "BVH"}, {"embree", "Embree"}, {"fcl", "FCL"}}},
    {"bytes a triangle", "memory", "300k", {{"bullet-bvh", "BVH"}, {"gimpact", "GImpact"}, {"fcl", "FCL"}}},
    {"Bullet world: contacts of belt and blisk",
     "world-contacts",
     "300k",
     {{"bullet-bvh", "BVH"}, {"gimpact", "GImpact"}}},
    {"Bullet world: closest points", "world-closest", "300k", {{"bullet-bvh", "BVH"}}},
    {"Bullet world: a ray", "world-ray", "300k", {{"bullet-bvh", "BVH"}, {"gimpact", "GImpact"}}},
    {"Bullet world: a ball swept", "world-sweep", "300k", {{"bullet-bvh", "BVH"}, {"gimpact", "GImpact"}}},
    {"Bullet world: a step with 200 hulls on the blisk",
     "world-step",
     "300k",
     {{"bullet-bvh", "BVH"}, {"gimpact", "GImpact"}}},
    {"the same on 1,500,000 triangles",
     "world-step",
     "1500k",
     {{"bullet-bvh", "BVH"}, {"gimpact", "GImpact"}}},
    {"Bullet world: a step with 64 concave bodies", "world-pile", "64-bodies", {{"gimpact", "GImpact"}}},
};

const Row* find(const Rows& rows, const Line& line, const std::string& contender) {
  for (const Row& row : rows) {
    if (row["task"] == line.task && row["scene"] == line.scene && row.value("contender", "") == contender)
      return &row;
  }
  return nullptr;
}

}  // namespace

std::string summaryTable(const Rows& rows) {
  MarkdownTable table({"asked", "ours", "others take times as much"});
  for (const Line& line : kLines) {
    const Row* ours = find(rows, line, "octoblisk");
    if (ours == nullptr) continue;
    std::string others;
    for (const auto& [contender, name] : line.peers) {
      const Row* row = find(rows, line, contender);
      if (row == nullptr || !(*row)["ratio"].is_number()) continue;
      others +=
          (others.empty() ? "" : ", ") + std::string(name) + ' ' + significant((*row)["ratio"].get<double>());
      if (row->value("differences", 0) > 0) others += '*';
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

}  // namespace octoblisk::bench
