// Queries random poses of hard meshes, a million by default. Compares the triangle pairs with exact
// arithmetic, and the distances with those of all pairs.
//
//   pose_soak [poses = 1000000] [scene]
//
// Prints rows by mesh, by scale, by distance from the origin and by tree. Exits with 1 if an answer differs,
// if fewer than 30 % or more than 70 % of the poses of many scenes touch, or if memory grows. The second
// argument is the first scene. A finding names its scene: pose_soak 200 SCENE runs only that one.
#include "shared/pose_soak.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "base/parallel.h"

namespace octoblisk::bench {

using namespace detail;

namespace {

using testing::SoakScene;
using testing::SoakTally;

constexpr int kPosesAScene = 200;
constexpr std::uint64_t kManyScenes = 50;

double residentMegabytes() {
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

std::string powerOfTen(double value) {
  const double exponent = 3.0 * std::floor(std::log10(value) / 3.0);
  return "1e" + std::to_string(static_cast<int>(exponent)) + " to 1e" +
         std::to_string(static_cast<int>(exponent) + 3);
}

/// The rows in the order of their first column: a label and its tally.
class Table {
 public:
  void add(const SoakScene& scene, const SoakTally& tally) {
    const std::lock_guard lock(mutex_);
    all_ += tally;
    const auto to = [&](const char* group, const std::string& row) { rows_[group][row] += tally; };
    to("1 mesh A", testing::nameOf(scene.a));
    to("2 mesh B", testing::nameOf(scene.b));
    to("3 size of A", powerOfTen(scene.scale));
    to("4 B to A", scene.ratio < 1.0 ? powerOfTen(scene.ratio) : "1");
    to("5 far, in sizes", scene.far > 0.0 ? powerOfTen(scene.far) : "0");
    to("6 trees", scene.tree);
  }

  const SoakTally& all() const { return all_; }

  void print() const {
    std::printf("%-16s %-14s %9s %6s %11s %7s %6s %10s %6s\n", "", "", "poses", "hits", "pairs", "missed",
                "wrong", "distances", "wrong");
    for (const auto& [group, rows] : rows_) {
      for (const auto& [row, tally] : rows) print(group + 2, row, tally);
    }
    print("all", "", all_);
  }

 private:
  static void print(const char* group, const std::string& row, const SoakTally& t) {
    const auto number = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
    std::printf("%-16s %-14s %9llu %5.1f%% %11llu %7llu %6llu %10llu %6llu\n", group, row.c_str(),
                number(t.poses), 100.0 * static_cast<double>(t.hits) / static_cast<double>(t.poses),
                number(t.pairs), number(t.missed), number(t.wrong), number(t.distances),
                number(t.wrong_distances));
  }

  std::mutex mutex_;
  std::map<const char*, std::map<std::string, SoakTally>,
           decltype([](const char* a, const char* b) { return std::string_view(a) < std::string_view(b); })>
      rows_;
  SoakTally all_;
};

int run(std::uint64_t poses, std::uint64_t first_scene) {
  constexpr std::uint64_t kChunks = 20;
  constexpr double kGrowth = 4.0;  // MB
  const auto begin = std::chrono::steady_clock::now();
  const double at_start = residentMegabytes();
  double warm = 0.0;
  Table table;
  const std::uint64_t scenes = (poses + kPosesAScene - 1) / kPosesAScene;
  for (std::uint64_t chunk = 0; chunk < kChunks; ++chunk) {
    const std::uint64_t from = scenes * chunk / kChunks, to = scenes * (chunk + 1) / kChunks;
    parallelFor(to - from, 0, [&](std::size_t index, std::size_t) {
      const std::uint64_t scene = first_scene + from + index;
      table.add(testing::soakScene(scene), testing::soak(scene, kPosesAScene));
    });
    if (chunk == 0) warm = residentMegabytes();
  }
  const double at_end = residentMegabytes();
  const SoakTally& all = table.all();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const double hits = static_cast<double>(all.hits) / static_cast<double>(all.poses);
  table.print();
  for (const std::string& finding : all.findings) std::printf("%s\n", finding.c_str());
  const bool is_varied = scenes < kManyScenes || (hits > 0.3 && hits < 0.7);
  const bool is_ok = all.agrees() && is_varied && at_end < warm + kGrowth;
  std::printf("pose_soak: %s, %.0f s, resident %.1f MB at the start, %.1f MB when warm, %.1f MB at the end\n",
              is_ok ? "ok" : "FAILED", seconds, at_start, warm, at_end);
  return is_ok ? 0 : 1;
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  const long long poses = argc > 1 ? std::atoll(argv[1]) : 1'000'000;
  const long long scene = argc > 2 ? std::atoll(argv[2]) : 0;
  if (poses <= 0 || scene < 0 || argc > 3) {
    std::fprintf(stderr, "usage: pose_soak [poses] [scene]\n");
    return 2;
  }
  return octoblisk::bench::run(static_cast<std::uint64_t>(poses), static_cast<std::uint64_t>(scene));
}
