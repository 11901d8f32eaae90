#include "session.h"

#include <benchmark/benchmark.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "demos/scratch_folder.h"

namespace octoblisk::bench {
namespace {

void rest(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(state.iterations());
}

TEST(Session, googlesFileIsJsonThatNamesTheProgram) {
  const demos::ScratchFolder folder;
  const SessionOptions options{
      .quick = true,
      .of_google = {"some/bench_rest", "--benchmark_out=" + (folder.path() / "google.json").string()}};
  const Session session(options, "50k");
  benchmark::RegisterBenchmark("rest", rest)->Iterations(1);
  session.run();

  std::ifstream file(folder.path() / "google-50k.json");
  const nlohmann::json google = nlohmann::json::parse(file);  // throws if the bytes are not UTF-8
  EXPECT_EQ(google.at("context").at("executable"), "some/bench_rest");
  ASSERT_EQ(google.at("benchmarks").size(), 1u);
  EXPECT_EQ(google.at("benchmarks")[0].at("run_name"), "rest/iterations:1");
}

}  // namespace
}  // namespace octoblisk::bench
