#include "paper/blisk_ranges.h"

#include <algorithm>

#include "build/paper/principal_box.h"
#include "geometry/bounding_box.h"
#include "io/number_text.h"
#include "paper/comparison_table.h"
#include "paper/published.h"

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

std::vector<std::string> rowOf(const std::string& name, const BliskRange& range, const BliskRange& whole) {
  return {name,
          std::to_string(range.boxes),
          rangeText(range.axis_aligned),
          changeText(whole.axis_aligned, range.axis_aligned),
          rangeText(range.principal),
          changeText(whole.axis_aligned, range.principal)};
}

/// "5 of 7"
std::string countLarger(const std::vector<BliskRange>& ranges, double than, double BliskRange::*volume) {
  const auto count =
      std::ranges::count_if(ranges, [&](const BliskRange& range) { return range.*volume > than; });
  return std::to_string(count) + " of " + std::to_string(ranges.size());
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

Section bliskRangesSection(const BliskRanges& ranges, std::size_t blades) {
  Table table{
      .name = "blisk_ranges",
      .caption =
          "Range of the whole blisk: the volume of the boxes with which a detection begins (10⁴ mm³), and "
          "its change compared with one box along the axes",
      .columns = {"division", "boxes", "along the axes", "change", "principal axes", "change of these"},
      .rows = {rowOf("one box", ranges.whole, ranges.whole)}};
  for (const BliskRange& range : ranges.at_once) {
    table.rows.push_back(rowOf("whole blisk at once, k = " + std::to_string(range.k), range, ranges.whole));
  }
  for (const BliskRange& range : ranges.by_parts) {
    const std::string name =
        range.k == 1 ? "only parts" : "parts, then k = " + std::to_string(range.k) + " each";
    table.rows.push_back(rowOf(name, range, ranges.whole));
  }
  const auto best = [](const std::vector<BliskRange>& of, double BliskRange::*volume) {
    return std::ranges::min(of, {}, volume).*volume;
  };
  const auto axis_aligned = &BliskRange::axis_aligned, principal = &BliskRange::principal;
  const double one = ranges.whole.axis_aligned;
  const BliskRange& paper_choice = ranges.by_parts[1];
  return {
      .title = "The whole blisk: parts first, or clusters at once",
      .paragraphs = {"The paper divides the blisk into its blades, and each blade into clusters. k-means "
                     "over the whole blisk at once makes boxes with a total volume above that of the one box "
                     "along the axes for " +
                         countLarger(ranges.at_once, one, axis_aligned) +
                         " values of k along the axes, and for " +
                         countLarger(ranges.at_once, one, principal) +
                         " in principal frames; at best it changes the range by " +
                         changeText(one, best(ranges.at_once, axis_aligned)) + " and " +
                         changeText(one, best(ranges.at_once, principal)) + ". A division into the " +
                         countedText(blades, "blade", "blades") +
                         " and the hub, each in one box, changes it by " +
                         changeText(one, ranges.by_parts[0].axis_aligned) + " and " +
                         changeText(one, ranges.by_parts[0].principal) +
                         "; with k = 2 clusters per part by " + changeText(one, paper_choice.axis_aligned) +
                         " and " + changeText(one, paper_choice.principal) + ", with the best k by " +
                         changeText(one, best(ranges.by_parts, axis_aligned)) + " and " +
                         changeText(one, best(ranges.by_parts, principal)) + ". The paper's Table 3 has " +
                         changeText(kPublishedTraditionalRange, kPublishedImprovedRange) + ".",
                     "Volumes are sums: a volume that several boxes share counts once for each of them."},
      .tables = {std::move(table)}};
}

}  // namespace octoblisk::demos
