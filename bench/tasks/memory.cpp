// The memory that a library keeps in addition to the caller's mesh, including copies of the mesh.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <memory>
#include <string>
#include <vector>

#include "contender.h"
#include "session.h"

namespace octoblisk::bench {
namespace {

std::size_t heapBytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

struct Measured {
  std::string contender;
  double bytes_a_triangle = 0.0;
};

void measure(benchmark::State& state, const Scene& scene, const Contender& contender, Measured& measured) {
  const std::unique_ptr<BuildQuery> query = contender.build(scene);
  std::size_t bytes = 0;
  for (auto _ : state) {
    query->clear();
    const std::size_t own_before = query->ownCount().value_or(0);
    const std::size_t heap_before = heapBytes();
    query->build();
    const auto own = query->ownCount();
    bytes = own ? *own - own_before : heapBytes() - heap_before;
  }
  measured.bytes_a_triangle = static_cast<double>(bytes) / static_cast<double>(scene.blisk->triangleCount());
  state.counters["bytes_a_triangle"] = measured.bytes_a_triangle;
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  using namespace octoblisk::bench;
  const SessionOptions options = sessionOptions(argc, argv);
  const std::vector<std::string> scenes =
      options.quick ? std::vector<std::string>{"50k"} : std::vector<std::string>{"50k", "300k", "1500k"};
  return forEachScene(options, scenes, [&](const std::string& scene) {
    const Session session(options, scene);
    std::vector<std::unique_ptr<Measured>> all;
    for (const Contender& contender : contenders()) {
      if (!contender.build) continue;
      const std::string name = "memory/" + scene + '/' + contender.name;
      Measured* measured = all.emplace_back(std::make_unique<Measured>(contender.name)).get();
      const auto run = [&contender, &scene, measured](benchmark::State& state) {
        measure(state, sceneNamed(scene), contender, *measured);
      };
      benchmark::RegisterBenchmark(name.c_str(), run)
          ->Iterations(1)
          ->Repetitions(1)
          ->Unit(benchmark::kMillisecond);
    }
    session.run();

    double ours = 0.0;
    Rows rows;
    for (const auto& m : all) {
      if (m->contender == kOurs) ours = m->bytes_a_triangle;
      if (m->bytes_a_triangle == 0.0) continue;  // filtered out
      Row row = {{"task", "memory"},
                 {"scene", scene},
                 {"contender", m->contender},
                 {"mean_us", nullptr},
                 {"median_us", nullptr},
                 {"answers_equal", nullptr},
                 {"bytes_a_triangle", m->bytes_a_triangle}};
      row["ratio"] = ours > 0.0 ? Row(m->bytes_a_triangle / ours) : Row(nullptr);
      rows.push_back(std::move(row));
    }
    session.finish(rows);
  });
}
