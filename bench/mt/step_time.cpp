// Measures a step of Bullet's plain and parallel worlds while 1,000 bodies fall onto the blisk.
//
//   mt_step [rows = mt.json]
//
// Prints a table and writes its rows. The worlds take turns in blocks of steps. The time of a block is the
// least of several passes, because other processes disturb several threads more than one.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "mt/bodies_on_blisk.h"
#include "report/rows.h"

namespace octoblisk::bench {
namespace {

constexpr int kBodies = 1000, kBlocks = 10, kBlockSteps = 24, kPasses = 3;
constexpr int kSteps = kBlocks * kBlockSteps;

struct Contender {
  WorldKind world;
  ShapeKind shapes;
  int threads;
  std::unique_ptr<BodiesOnBlisk> scene = {};
  std::array<double, kBlocks> least = {};  // s, of all passes
  int points = 0, lost = 0;

  Contender(WorldKind its_world, ShapeKind its_shapes, int its_threads)
      : world(its_world), shapes(its_shapes), threads(its_threads) {
    least.fill(std::numeric_limits<double>::infinity());
  }

  void start() {
    useThreads(threads);
    scene = std::make_unique<BodiesOnBlisk>(world, shapes, kBodies);
  }
  void run(std::size_t block) {
    useThreads(threads);
    const auto begin = std::chrono::steady_clock::now();
    for (int step = 0; step < kBlockSteps; ++step) scene->step();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    least[block] = std::min(least[block], spent.count());
  }
  void end() {
    points = 0;
    btDispatcher& dispatcher = *scene->world().getDispatcher();
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m)
      points += dispatcher.getManifoldByIndexInternal(m)->getNumContacts();
    lost = scene->lost();
    scene.reset();
  }
  double time() const { return 1e3 / kSteps * std::accumulate(least.begin(), least.end(), 0.0); }
};

void run(const char* file) {
  std::vector<Contender> contenders;
  for (const ShapeKind shapes : {ShapeKind::bvh, ShapeKind::octoblisk}) {
    contenders.emplace_back(WorldKind::plain, shapes, 1);
    for (const int threads : {1, 2, 4}) contenders.emplace_back(WorldKind::parallel, shapes, threads);
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    for (Contender& contender : contenders) contender.start();
    for (std::size_t block = 0; block < kBlocks; ++block) {
      for (Contender& contender : contenders) contender.run(block);
    }
    for (Contender& contender : contenders) contender.end();
  }
  Rows rows;
  std::printf("%-28s%-12s%8s%12s%8s%6s\n", "world", "shapes", "threads", "ms a step", "points", "lost");
  for (const Contender& contender : contenders) {
    const char* const world =
        contender.world == WorldKind::plain ? "btDiscreteDynamicsWorld" : "btDiscreteDynamicsWorldMt";
    std::printf("%-28s%-12s%8d%12.2f%8d%6d\n", world, nameOf(contender.shapes), contender.threads,
                contender.time(), contender.points, contender.lost);
    rows.push_back({{"task", "mt-step"},
                    {"scene", world},
                    {"contender", nameOf(contender.shapes)},
                    {"threads", contender.threads},
                    {"step_ms", contender.time()},
                    {"points", contender.points},
                    {"lost", contender.lost},
                    {"bodies", kBodies},
                    {"steps", kSteps},
                    {"passes", kPasses}});
  }
  addRows(file, rows);
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  try {
    if (argc > 2 || (argc == 2 && argv[1][0] == '-')) throw std::runtime_error("usage: mt_step [rows]");
    octoblisk::bench::run(argc == 2 ? argv[1] : "mt.json");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mt_step: %s\n", error.what());
    return 2;
  }
}
