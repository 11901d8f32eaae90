#include "paper/detection_seeds.h"

#include <utility>

#include "build/paper/principal_box.h"
#include "paper/box_detection.h"
#include "paper/paper_octrees.h"
#include "paper/stopwatch.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

double secondsOf(const Segmentation& octrees, const Obb& belt_box, std::span<const Pose> poses) {
  const Stopwatch watch;
  for (const Pose& pose : poses) leavesNear(octrees, pose * belt_box, SeparatingAxes::exact15);
  return watch.seconds();
}

/// The improved method's median time divided by the traditional method's; the two are timed alternately.
double timeRatio(const PaperOctrees& octrees, const Obb& belt_box, std::span<const Pose> poses, int runs) {
  std::vector<double> traditional, improved;
  for (int run = 0; run < runs; ++run) {
    traditional.push_back(secondsOf(octrees.traditional, belt_box, poses));
    improved.push_back(secondsOf(octrees.improved, belt_box, poses));
  }
  return spreadOf(improved).median / spreadOf(traditional).median;
}

double principalRange(std::span<const Points> clusters) {
  double volume = 0.0;
  for (const Points& cluster : clusters) volume += principalBox(cluster).volume();
  return volume;
}

/// "; the sign depends on the seed"
std::string openSign(const Spread& ratios) {
  return isSignOpen(ratios) ? "; the sign depends on the seed" : "";
}

}  // namespace

DetectionSeeds detectionOverSeeds(const std::function<std::vector<Points>(std::uint64_t seed)>& parts_of_seed,
                                  const Obb& belt_box, std::span<const Pose> belt_in_blisk,
                                  const DetectionSeedOptions& options, const Progress& progress) {
  DetectionSeeds seeds;
  for (std::size_t i = 0; i < options.count; ++i) {
    KMeansOptions k_means = options.k_means;
    k_means.seed += i;
    const PaperOctrees octrees(parts_of_seed(k_means.seed), k_means, options.fnop);
    const double traditional = octrees.traditional.rootVolume();
    seeds.range.push_back(octrees.improved.rootVolume() / traditional);
    seeds.principal_range.push_back(principalRange(octrees.clusters) / traditional);
    seeds.seconds.push_back(timeRatio(octrees, belt_box, belt_in_blisk, options.runs));
    progress(static_cast<double>(i + 1) / static_cast<double>(options.count));
  }
  return seeds;
}

Table seedsTable(std::string name, const std::string& of, const DetectionSeeds& seeds) {
  Table table{
      .name = std::move(name),
      .caption =
          of + " over " + std::to_string(seeds.count()) +
          " seeds of clouds and clusters: change by the improved method, compared with the traditional one",
      .columns = {"attribute", "mean", "least", "most"},
      .rows = {}};
  const auto add = [&](const std::string& attribute, const std::vector<double>& ratios) {
    const Spread spread = spreadOf(ratios);
    table.rows.push_back({attribute, changeText(1.0, spread.mean), changeText(1.0, spread.least),
                          changeText(1.0, spread.most)});
  };
  add("range, boxes along the axes", seeds.range);
  add("range, boxes along principal axes", seeds.principal_range);
  add("time", seeds.seconds);
  return table;
}

std::string seedsVerdict(const DetectionSeeds& seeds) {
  const Spread range = spreadOf(seeds.range), seconds = spreadOf(seeds.seconds);
  return "Seeds: over " + std::to_string(seeds.count()) +
         " seeds of clouds and clusters, parts and clusters change the range by " + changeText(range) +
         openSign(range) + ". With boxes along principal axes they change it by " +
         changeText(spreadOf(seeds.principal_range)) + ". They change the time by " + changeText(seconds) +
         openSign(seconds) + ".";
}

std::vector<Claim> seedsClaims(const std::string& table, const DetectionSeeds& seeds,
                               const DetectionTable& paper) {
  const double papers_time =
      spreadOf(paper.improved.seconds).median / spreadOf(paper.traditional.seconds).median;
  return {{table + ": collision detection range, called accuracy in the paper",
           changeText(paper.traditional.range, paper.improved.range), changeText(spreadOf(seeds.range))},
          {table + ": collision detection time", changeText(1.0, papers_time),
           changeText(spreadOf(seeds.seconds))}};
}

}  // namespace octoblisk::demos
