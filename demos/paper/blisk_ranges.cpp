#include "paper/blisk_ranges.h"

#include <nlohmann/json.hpp>

#include "build/paper/principal_box.h"
#include "geometry/bounding_box.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr std::size_t kMaxClusters = 8;

BliskRange rangeOf(std::size_t k, std::span<const Points> clouds) {
  BliskRange range{.k = k, .boxes = clouds.size()};
  for (const Points& cloud : clouds) {
    range.axis_aligned += boundingBox(cloud, Mat3::Identity()).volume();
    range.principal += principalBox(cloud).volume();
  }
  return range;
}

}  // namespace

BliskRanges findBliskRanges(std::span<const Points> parts, const KMeansOptions& k_means) {
  KMeansOptions of_k = k_means;
  BliskRanges ranges;
  const Points whole = joined(parts);
  ranges.whole = rangeOf(1, std::span(&whole, 1));
  for (std::size_t k = 2; k <= kMaxClusters; ++k) {
    of_k.k = k;
    ranges.at_once.push_back(rangeOf(k, clustersOf(whole, of_k)));
  }
  for (std::size_t k = 1; k <= kMaxClusters; ++k) {
    of_k.k = k;
    ranges.by_parts.push_back(rangeOf(k, clustersOfParts(parts, of_k)));
  }
  return ranges;
}

void to_json(nlohmann::json& json, const BliskRange& range) {
  json = {{"k", range.k},
          {"boxes", range.boxes},
          {"axis_aligned", range.axis_aligned},
          {"principal", range.principal}};
}

void to_json(nlohmann::json& json, const BliskRanges& ranges) {
  json = {{"whole", ranges.whole}, {"at_once", ranges.at_once}, {"by_parts", ranges.by_parts}};
}

}  // namespace octoblisk::demos
