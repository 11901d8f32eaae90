// Times depth queries: the belt in the default blisk, and solids inside solids.
#include <benchmark/benchmark.h>

#include "models/belt_grinder.h"
#include "models/blade_finder.h"
#include "models/blisk.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/collide.h"
#include "octoblisk/containment.h"
#include "octoblisk/depth.h"
#include "shared/meshes.h"
#include "toolpath/grinding_path.h"

namespace octoblisk {
namespace {

struct Scene {
  std::shared_ptr<const TriangleMesh> blisk =
      std::make_shared<const TriangleMesh>(demos::makeDefaultBlisk(300'000).mesh);
  std::shared_ptr<const TriangleMesh> belt = std::make_shared<const TriangleMesh>(demos::makeBelt());
  ClusteredOctree blisk_tree = ClusteredOctree::build(blisk), belt_tree = ClusteredOctree::build(belt);
  Surface blisk_surface{blisk_tree}, belt_surface{belt_tree};
};

const Scene& scene() {
  static const Scene scene;
  return scene;
}

/// The poses that touch, of a path whose belt is pressed in by `depth`.
std::vector<Pose> touchingPoses(double depth) {
  demos::GrindingPathOptions options;
  options.depth = depth;
  std::vector<Pose> path =
      demos::makeGrindingPath(*scene().blisk, demos::findBlades(*scene().blisk), options);
  std::erase_if(path,
                [&](const Pose& pose) { return !collide(scene().blisk_tree, scene().belt_tree, pose); });
  return path;
}

void depthOfTouchingPoses(benchmark::State& state) {
  const std::vector<Pose> path = touchingPoses(static_cast<double>(state.range(0)) * 1e-3);
  const double tolerance = static_cast<double>(state.range(1)) * 1e-6;
  DepthQuery query;
  std::size_t pose = 0;
  double deepest = 0.0;
  for (auto _ : state) {
    deepest = std::max(
        deepest, query.deepest(scene().blisk_surface, scene().belt_surface, path[pose], tolerance).depth);
    pose = (pose + 1) % path.size();
  }
  state.counters["poses"] = static_cast<double>(path.size());
  state.counters["deepest_um"] = 1e3 * deepest;
}

/// A pin in a hole that is 1 µm wider, pressed 1 µm into its wall. Each has 5,760 triangles.
void depthOfPinInHole(benchmark::State& state) {
  const double tolerance = static_cast<double>(state.range(0)) * 1e-6;
  const auto solid = [](double inner, double outer, double height) {
    return ClusteredOctree::build(testing::tube(inner, outer, height, 720));
  };
  const ClusteredOctree block = solid(5.001, 10.0, 5.0), pin = solid(2.0, 5.0, 10.0);
  const Surface block_surface(block), pin_surface(pin);
  const Pose pose{Eigen::AngleAxisd(1e-4, Vec3(3, 2, 1).normalized()).toRotationMatrix(),
                  Vec3(0.002, 0.0, 0.3)};
  DepthQuery query;
  for (auto _ : state) {
    benchmark::DoNotOptimize(query.deepest(block_surface, pin_surface, pose, tolerance).depth);
  }
}

/// The depth of the blisk in itself.
void depthOnItself(benchmark::State& state) {
  DepthQuery query;
  for (auto _ : state) {
    benchmark::DoNotOptimize(query.deepest(scene().blisk_surface, scene().blisk_surface, Pose(), 1e-3).depth);
  }
}

void containmentOfTouchingPoses(benchmark::State& state) {
  const std::vector<Pose> path = touchingPoses(0.02);
  std::size_t pose = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(containment(scene().blisk_surface, scene().belt_surface, path[pose]));
    pose = (pose + 1) % path.size();
  }
}

std::vector<Vec3> pointsInBounds() {
  std::mt19937_64 random(7);
  std::vector<Vec3> points;
  const Aabb& bounds = scene().blisk->bounds();
  for (int i = 0; i < 4096; ++i) {
    points.push_back(bounds.center() + testing::randomPoint(random, 1.0).cwiseProduct(bounds.halfExtents()));
  }
  return points;
}

void locatePoint(benchmark::State& state) {
  const std::vector<Vec3> points = pointsInBounds();
  std::size_t i = 0, inside = 0;
  for (auto _ : state) {
    inside += locate(scene().blisk_surface, points[i++ % points.size()]) == PointLocation::inside;
  }
  state.counters["inside"] = static_cast<double>(inside) / static_cast<double>(i);
}

void closestPointOfBlisk(benchmark::State& state) {
  const std::vector<Vec3> points = pointsInBounds();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(closestPoint(scene().blisk_tree, points[i++ % points.size()]));
  }
}

void makeSurface(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Surface(scene().blisk_tree).isClosed());
}

BENCHMARK(depthOfTouchingPoses)
    ->ArgNames({"pressed_um", "tolerance_nm"})
    ->Args({20, 1000})
    ->Args({20, 100})
    ->Args({200, 1000})
    ->Args({2000, 1000})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(depthOfPinInHole)
    ->ArgName("tolerance_nm")
    ->Arg(1000)
    ->Arg(100)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(depthOnItself)->Unit(benchmark::kMillisecond);
BENCHMARK(containmentOfTouchingPoses)->Unit(benchmark::kMicrosecond);
BENCHMARK(locatePoint)->Unit(benchmark::kMicrosecond);
BENCHMARK(closestPointOfBlisk)->Unit(benchmark::kMicrosecond);
BENCHMARK(makeSurface)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace octoblisk
