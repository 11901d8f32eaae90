// How long a tree takes to build and a pose to be checked: the belt over the default blisk, by its triangles.
#include <benchmark/benchmark.h>

#include <map>

#include "models/belt_grinder.h"
#include "models/blade_finder.h"
#include "models/blisk.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "toolpath/grinding_path.h"

namespace octoblisk {
namespace {

struct Scene {
  std::shared_ptr<const TriangleMesh> blisk, belt;
  ClusteredOctree blisk_tree, belt_tree;
  std::vector<Pose> path;
};

const Scene& sceneOf(std::int64_t triangles) {
  static std::map<std::int64_t, Scene> scenes;
  const auto known = scenes.find(triangles);
  if (known != scenes.end()) return known->second;
  const auto blisk =
      std::make_shared<const TriangleMesh>(demos::makeDefaultBlisk(static_cast<std::size_t>(triangles)).mesh);
  const auto belt = std::make_shared<const TriangleMesh>(demos::makeBelt());
  Scene scene{blisk, belt, ClusteredOctree::build(blisk), ClusteredOctree::build(belt),
              demos::makeGrindingPath(*blisk, demos::findBlades(*blisk), {})};
  return scenes.emplace(triangles, std::move(scene)).first->second;
}

void build(benchmark::State& state) {
  const Scene& scene = sceneOf(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(ClusteredOctree::build(scene.blisk));
  state.counters["bytes_a_triangle"] =
      static_cast<double>(scene.blisk_tree.stats().bytes) / static_cast<double>(scene.blisk->triangleCount());
}

void collidePath(benchmark::State& state) {
  const Scene& scene = sceneOf(state.range(0));
  std::size_t pose = 0, hits = 0, checked = 0;
  for (auto _ : state) {
    hits += collide(scene.blisk_tree, scene.belt_tree, scene.path[pose]).has_value();
    pose = (pose + 1) % scene.path.size();
    ++checked;
  }
  state.counters["hit_rate"] = static_cast<double>(hits) / static_cast<double>(checked);
}

void contactsPath(benchmark::State& state) {
  const Scene& scene = sceneOf(state.range(0));
  std::vector<Contact> found;
  std::size_t pose = 0;
  for (auto _ : state) {
    contacts(scene.blisk_tree, scene.belt_tree, scene.path[pose], 0.0, found);
    benchmark::DoNotOptimize(found.data());
    pose = (pose + 1) % scene.path.size();
  }
}

BENCHMARK(build)->Arg(50'000)->Arg(300'000)->Unit(benchmark::kMillisecond);
BENCHMARK(collidePath)->Arg(50'000)->Arg(300'000)->Unit(benchmark::kMicrosecond);
BENCHMARK(contactsPath)->Arg(50'000)->Arg(300'000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace octoblisk
