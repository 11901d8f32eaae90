#include "paper/split_times_section.h"

#include "io/number_text.h"
#include "paper/fnop_table.h"
#include "paper/published.h"

namespace octoblisk::demos {

namespace {

Table timesTable(const MethodTable<double>& milliseconds) {
  Table table = fnopTable("table2_times",
                          "Table 2: split time with cubes along the axes, here and in the paper, and its "
                          "change compared with the traditional method");
  for (std::size_t method = 0; method < kMethods; ++method) {
    const std::string name = nameOfMethod(method);
    const auto change = [&](const MethodTable<double>& times) {
      return [&times, method](std::size_t column) {
        return changeText(1.0, ratioToTraditional(times, method, column));
      };
    };
    addRow(table, name + ", here (ms)",
           [&](std::size_t column) { return fixedText(milliseconds[method][column], 3); });
    addRow(table, name + ", paper (s)",
           [&](std::size_t column) { return fixedText(kPublishedSeconds[method][column], 2); });
    if (method == 0) continue;
    addRow(table, name + ", change here", change(milliseconds));
    addRow(table, name + ", change in the paper", change(kPublishedSeconds));
  }
  return table;
}

Table clusteringTable(const SplitResult& result) {
  Table table{
      .name = "table2_clustering",
      .caption = "Time of k-means, which runs before the splits and is not in any of the times above (ms)",
      .columns = {"k"},
      .rows = {{"ms"}}};
  for (std::size_t method = 1; method < kMethods; ++method) {
    table.columns.push_back(std::to_string(clustersOfMethod(method)));
    table.rows.front().push_back(fixedText(result.cluster_ms[method], 3));
  }
  return table;
}

}  // namespace

std::vector<Claim> splitTimesClaims(const SplitRun& run) {
  const auto times = numbersOf(run.result.cubes, &SplitCell::split_ms);
  const std::size_t k2 = methodOfClusters(2), fnop2 = columnOfFnop(2);
  return {{"Table 2: split time at k = 2 and FNOP 2, without k-means",
           changeText(1.0, ratioToTraditional(kPublishedSeconds, k2, fnop2)),
           changeText(1.0, ratioToTraditional(times, k2, fnop2))},
          {"Table 2: split time, mean over k and FNOP", meanChangeText(kPublishedSeconds, kPublishedSeconds),
           meanChangeText(times, times)}};
}

Section splitTimesSection(const SplitRun& run) {
  const auto cubes = numbersOf(run.result.cubes, &SplitCell::split_ms);
  const auto principal = numbersOf(run.result.principal, &SplitCell::split_ms);
  const std::size_t k2 = methodOfClusters(2), fnop2 = columnOfFnop(2);
  const double with_clustering = cubes[k2][fnop2] + run.result.cluster_ms[k2];
  return {
      .title = "Table 2: split time",
      .paragraphs = {"Processor time to build the octrees of given clusters: the median of interleaved "
                     "repeats in one run on this machine. The paper's times are " +
                         fixedText(kPublishedSeconds[0][0] / cubes[0][0], 0) +
                         " thousand times as long at FNOP 1, so only changes compared with the traditional "
                         "method of the same table are comparable.",
                     "Clustering is faster in " + cellsBelowText(cubes) +
                         " with cubes along the axes and in " + cellsBelowText(principal) +
                         " with boxes in principal frames; in the paper's table in " +
                         cellsBelowText(kPublishedSeconds) + ". The mean change is " +
                         meanChangeText(cubes, cubes) + ", " + meanChangeText(principal, principal) +
                         " and, in the paper, " + meanChangeText(kPublishedSeconds, kPublishedSeconds) +
                         ". At k = 2 and FNOP 2 it is " + changeText(cubes[0][fnop2], cubes[k2][fnop2]) +
                         " here and " +
                         changeText(kPublishedSeconds[0][fnop2], kPublishedSeconds[k2][fnop2]) +
                         " in the paper (erratum 11); with the time of k-means it is " +
                         changeText(cubes[0][fnop2], with_clustering) + " here."},
      .tables = {timesTable(cubes), seedsTable("table2_seeds", "Split time", run, &SplitCell::split_ms),
                 oneRowPerMethod(
                     "table2_times_principal",
                     "Split time with boxes in principal frames, including the time to find the frames (ms)",
                     [&](std::size_t m, std::size_t c) { return fixedText(principal[m][c], 3); }),
                 clusteringTable(run.result)}};
}

}  // namespace octoblisk::demos
