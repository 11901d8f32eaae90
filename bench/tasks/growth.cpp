// How the time of a query grows with the number of triangles: 10,000 to 5 million of the blisk, 2,000 to
// 200,000 of the belt. The rows' `size` is that number.
#include <algorithm>

#include "boolean.h"
#include "build.h"
#include "distance.h"
#include "ray.h"

namespace octoblisk::bench {
namespace {

const std::vector<std::string> kBlisks = {"10k", "30k", "100k", "300k", "1000k", "3000k", "5000k"};
const std::vector<std::string> kBelts = {"belt-2k", "belt-6k", "belt-20k", "belt-60k", "belt-200k"};

bool isBelt(const std::string& scene) { return scene.starts_with("belt"); }

/// The task on scenes of growing size, for the named contenders. Other libraries skip the largest scenes if
/// they would need gigabytes.
TimedTask growing(TimedTask task, const std::vector<std::string>& names, bool with_belts) {
  task.scenes = kBlisks;
  task.quick_scenes = {"10k"};
  if (with_belts) {
    task.scenes.insert(task.scenes.end(), kBelts.begin(), kBelts.end());
    task.quick_scenes.emplace_back("belt-2k");
  }
  task.poses = 220;
  task.takes_part = [names](const Contender& contender, const std::string& scene) {
    const bool is_large = scene == "3000k" || scene == "5000k";
    return std::ranges::find(names, contender.name) != names.end() && !(is_large && contender.name == "fcl");
  };
  task.prepare = [prepare = task.prepare](const Scene& scene, const Contender& contender) {
    Trial trial = prepare(scene, contender);
    const TriangleMesh& mesh = isBelt(scene.name) ? *scene.belt : *scene.blisk;
    trial.counters["size"] = static_cast<double>(mesh.triangleCount());
    return trial;
  };
  return task;
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  // All threads of a contender are pinned to one core, so wall-clock time is their total time.
  return runTimedTasks(argc, argv,
                       {growing(booleanTask("growth-boolean", &Scene::path, true), {kOurs, "fcl"}, true),
                        growing(distanceTask("growth-distance", false), {kOurs, "fcl"}, true),
                        growing(rayTask("growth-ray"), {kOurs, "embree", "bullet-bvh"}, false),
                        growing(buildTask("growth-build"), {kOurs, "embree", "bullet-bvh", "fcl"}, false)});
}
