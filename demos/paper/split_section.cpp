#include "paper/split_section.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "paper/number_text.h"
#include "report/plot.h"

namespace octoblisk::demos {
namespace {

using CellText = std::function<std::string(std::size_t method, std::size_t column)>;
constexpr std::size_t kImprovedCells = (kMethods - 1) * kFnops;

template <typename Number>
MethodTable<Number> columnOf(const MethodTable<SplitCell>& cells, Number SplitCell::*number) {
  MethodTable<Number> table{};
  for (std::size_t method = 0; method < kMethods; ++method) {
    for (std::size_t column = 0; column < kFnops; ++column)
      table[method][column] = cells[method][column].*number;
  }
  return table;
}

Table fnopTable(std::string name, std::string caption) {
  Table table{.name = std::move(name), .caption = std::move(caption), .columns = {"FNOP"}, .rows = {}};
  for (std::size_t column = 0; column < kFnops; ++column) {
    table.columns.push_back(std::to_string(fnopOf(column)));
  }
  return table;
}

void addRow(Table& table, const std::string& name, std::size_t method, const CellText& text) {
  table.rows.push_back({name});
  for (std::size_t column = 0; column < kFnops; ++column) table.rows.back().push_back(text(method, column));
}

Table oneRowAMethod(std::string name, std::string caption, const CellText& text) {
  Table table = fnopTable(std::move(name), std::move(caption));
  for (std::size_t method = 0; method < kMethods; ++method) addRow(table, nameOfMethod(method), method, text);
  return table;
}

std::string ofCells(int count) {
  return std::to_string(count) + " of " + std::to_string(kImprovedCells) + " cells";
}

Table nodesTable(const SplitRun& run) {
  Table table = fnopTable(
      "table1_nodes",
      "Table 1: total number of nodes (TNON) with cubes along the axes, here and in the paper. * cannot be "
      "k + 8 · splits (erratum 10)");
  for (std::size_t method = 0; method < kMethods; ++method) {
    const std::string name = nameOfMethod(method);
    addRow(table, name + ", here", method,
           [&](std::size_t m, std::size_t c) { return std::to_string(run.result.cubes[m][c].nodes); });
    addRow(table, name + ", paper", method, [](std::size_t m, std::size_t c) {
      const int nodes = kPublishedNodes[m][c];
      return std::to_string(nodes) + (canBeNodeCount(nodes, clustersOfMethod(m)) ? "" : "*");
    });
    addRow(table, name + ", difference", method, [&](std::size_t m, std::size_t c) {
      return changeText(kPublishedNodes[m][c], static_cast<double>(run.result.cubes[m][c].nodes), 0);
    });
  }
  return table;
}

Table seedsTable(const SplitRun& run) {
  Table table{.name = "table1_seeds",
              .caption = "Nodes against the traditional method, mean over FNOP 1–10, of " +
                         std::to_string(run.ratios_of_seeds.size()) +
                         " other clouds and clusterings by other seeds",
              .columns = {"k", "fewest", "mean", "most"},
              .rows = {}};
  for (std::size_t m = 0; m + 1 < kMethods; ++m) {
    double least = run.ratios_of_seeds.front()[m], most = least, sum = 0.0;
    for (const auto& ratios : run.ratios_of_seeds) {
      least = std::min(least, ratios[m]);
      most = std::max(most, ratios[m]);
      sum += ratios[m];
    }
    table.rows.push_back({std::to_string(clustersOfMethod(m + 1)), changeText(1.0, least),
                          changeText(1.0, sum / static_cast<double>(run.ratios_of_seeds.size())),
                          changeText(1.0, most)});
  }
  return table;
}

Table kOptTable(const SplitRun& run) {
  Table table = fnopTable("table1_k_opt", "k_opt (step 5) by two criteria (erratum 5)");
  addRow(table, "fewest nodes, cubes along the axes", 0,
         [&](std::size_t, std::size_t c) { return std::to_string(kOfLeastNodes(run.result, c)); });
  addRow(table, "least leaf volume, principal frames", 0,
         [&](std::size_t, std::size_t c) { return std::to_string(kOfLeastLeafVolume(run.result, c)); });
  addRow(table, "fewest nodes, the paper's Table 1", 0, [](std::size_t, std::size_t c) {
    std::size_t best = 1;
    for (std::size_t m = 2; m < kMethods; ++m) {
      if (kPublishedNodes[m][c] < kPublishedNodes[best][c]) best = m;
    }
    return std::to_string(clustersOfMethod(best));
  });
  return table;
}

/// How far the traditional row here is from the paper's, in the mean: the cloud is chosen, the paper gives
/// none.
double rmsDifference(const SplitRun& run, std::size_t first_column) {
  double sum = 0.0;
  for (std::size_t c = first_column; c < kFnops; ++c) {
    const double ratio = static_cast<double>(run.result.cubes[0][c].nodes) / kPublishedNodes[0][c];
    sum += std::log(ratio) * std::log(ratio);
  }
  return std::sqrt(sum / static_cast<double>(kFnops - first_column));
}

/// "k = 2 at FNOP 2 (-12.8 %)"
template <typename Number>
std::string bestText(const MethodTable<Number>& table) {
  const TableCell best = bestAgainstTraditional(table);
  return nameOfMethod(best.method) + " at FNOP " + std::to_string(fnopOf(best.column)) + " (" +
         changeText(static_cast<double>(table[0][best.column]),
                    static_cast<double>(table[best.method][best.column])) +
         ")";
}

/// The mean over the improved cells of their ratio to the traditional cell of the same FNOP.
template <typename Number>
double meanRatio(const MethodTable<Number>& improved, const MethodTable<Number>& traditional) {
  double sum = 0.0;
  for (std::size_t m = 1; m < kMethods; ++m) {
    for (std::size_t c = 0; c < kFnops; ++c) {
      sum += static_cast<double>(improved[m][c]) / static_cast<double>(traditional[0][c]);
    }
  }
  return sum / kImprovedCells;
}

std::string nodesVerdict(const SplitRun& run) {
  const auto cubes = columnOf(run.result.cubes, &SplitCell::nodes);
  const auto principal = columnOf(run.result.principal, &SplitCell::nodes);
  const std::size_t k2 = methodOfClusters(2);
  return "Clustering makes fewer nodes in " + ofCells(cellsBelowTraditional(cubes)) +
         " with cubes along the axes and in " + ofCells(cellsBelowTraditional(principal)) +
         " with boxes in principal frames; in the paper's table in " +
         ofCells(cellsBelowTraditional(kPublishedNodes)) + ". The mean change is " +
         changeText(1.0, meanRatio(cubes, cubes)) + ", " + changeText(1.0, meanRatio(principal, principal)) +
         " and, in the paper, " + changeText(1.0, meanRatio(kPublishedNodes, kPublishedNodes)) +
         ". At k = 2 and FNOP 2, the paper's optimum, it is " +
         changeText(static_cast<double>(cubes[0][1]), static_cast<double>(cubes[k2][1])) + " here and " +
         changeText(kPublishedNodes[0][1], kPublishedNodes[k2][1]) +
         " in the paper; the greatest gain is at " + bestText(cubes) + " here, at " +
         bestText(kPublishedNodes) + " in the paper.";
}

std::string volumesVerdict(const SplitRun& run) {
  const auto cubes = columnOf(run.result.cubes, &SplitCell::leaf_volume);
  const auto principal = columnOf(run.result.principal, &SplitCell::leaf_volume);
  double frames_alone = 0.0;
  for (std::size_t c = 0; c < kFnops; ++c) frames_alone += principal[0][c] / cubes[0][c] / kFnops;
  return "A count of nodes is no accuracy (erratum 6). What the boxes leave to be examined is the volume of "
         "the "
         "leaf cells that hold points: against the traditional cubes, clusters alone change it by " +
         changeText(1.0, meanRatio(cubes, cubes)) + " in the mean, the principal frame alone by " +
         changeText(1.0, frames_alone) + ", and clusters each in a principal frame of their own by " +
         changeText(1.0, meanRatio(principal, cubes)) + ".";
}

std::string alarmsVerdict(const SplitRun& run) {
  const auto sums = [](const MethodTable<SplitCell>& cells, std::size_t SplitCell::*count) {
    double traditional = 0.0, improved = 0.0;
    for (std::size_t c = 0; c < kFnops; ++c) {
      traditional += static_cast<double>(cells[0][c].*count) / kFnops;
      for (std::size_t m = 1; m < kMethods; ++m) {
        improved += static_cast<double>(cells[m][c].*count) / kImprovedCells;
      }
    }
    return std::pair(traditional, improved);
  };
  const auto share = [&](double count) {
    return shareText(count, static_cast<double>(std::max<std::size_t>(run.result.clear, 1)));
  };
  const auto [old_cubes, new_cubes] = sums(run.result.cubes, &SplitCell::false_positives);
  const auto [old_boxes, new_boxes] = sums(run.result.principal, &SplitCell::false_positives);
  const auto [missed_cubes, missed_new_cubes] = sums(run.result.cubes, &SplitCell::false_negatives);
  const auto [missed_boxes, missed_new_boxes] = sums(run.result.principal, &SplitCell::false_negatives);
  return "Of " + std::to_string(run.result.touching + run.result.clear) +
         " seeded poses of the belt about the blade, its triangles touch the blade's at " +
         std::to_string(run.result.touching) + ". Of the " + std::to_string(run.result.clear) +
         " clear ones, the belt's one box overlaps a leaf cell of the traditional cubes at " +
         share(old_cubes) + ", of the clusters' cubes at " + share(new_cubes) + ", in principal frames at " +
         share(old_boxes) + " and " + share(new_boxes) +
         " (means over FNOP and k). Of the touching ones it misses " + fixedText(missed_cubes, 1) + ", " +
         fixedText(missed_new_cubes, 1) + ", " + fixedText(missed_boxes, 1) + " and " +
         fixedText(missed_new_boxes, 1) + " in the mean.";
}

}  // namespace

Section nodesSection(const SplitRun& run) {
  const auto volume = [](const MethodTable<SplitCell>& cells) {
    return [&cells](std::size_t m, std::size_t c) { return fixedText(1e-3 * cells[m][c].leaf_volume, 1); };
  };
  const auto positives = [&](const MethodTable<SplitCell>& cells) {
    return [&cells, clear = static_cast<double>(std::max<std::size_t>(run.result.clear, 1))](std::size_t m,
                                                                                             std::size_t c) {
      const SplitCell& cell = cells[m][c];
      const std::string share = shareText(static_cast<double>(cell.false_positives), clear);
      return cell.false_negatives == 0 ? share
                                       : share + ", " + std::to_string(cell.false_negatives) + " missed";
    };
  };
  Section section{
      .title = "Table 1: nodes",
      .paragraphs =
          {"The blade: " + run.blade_name + ", " + std::to_string(run.points) +
               " about even points. The paper does not say how many it has; the traditional row here is " +
               shareText(rmsDifference(run, 0), 1.0) +
               " from the paper's (root mean square of the logarithms), " +
               shareText(rmsDifference(run, 2), 1.0) +
               " over FNOP 3–10: at 1 and 2 the closest pairs of points count, which even points keep "
               "apart. "
               "A node is divided while it has more points than FNOP; TNON counts all nodes, the empty ones "
               "too: "
               "k + 8 · splits.",
           nodesVerdict(run), volumesVerdict(run), alarmsVerdict(run)},
      .tables = {
          nodesTable(run),
          oneRowAMethod(
              "table1_nodes_principal", "TNON with boxes in principal frames, each cluster its own",
              [&](std::size_t m, std::size_t c) { return std::to_string(run.result.principal[m][c].nodes); }),
          kOptTable(run),
          oneRowAMethod("table1_volume",
                        "Volume of the leaf cells with points, cubes along the axes (10³ mm³)",
                        volume(run.result.cubes)),
          oneRowAMethod("table1_volume_principal",
                        "Volume of the leaf cells with points, boxes in principal frames (10³ mm³)",
                        volume(run.result.principal)),
          oneRowAMethod("table1_false_positives",
                        "False positives: share of the clear poses called colliding, cubes along the axes",
                        positives(run.result.cubes)),
          oneRowAMethod(
              "table1_false_positives_principal",
              "False positives: share of the clear poses called colliding, boxes in principal frames",
              positives(run.result.principal))}};
  if (!run.ratios_of_seeds.empty()) section.tables.insert(section.tables.begin() + 2, seedsTable(run));
  return section;
}

Section timesSection(const SplitRun& run) {
  const auto cubes = columnOf(run.result.cubes, &SplitCell::split_ms);
  const auto principal = columnOf(run.result.principal, &SplitCell::split_ms);
  Table table = fnopTable(
      "table2_times",
      "Table 2: split time with cubes along the axes, here and in the paper, and its change against the "
      "traditional method");
  for (std::size_t method = 0; method < kMethods; ++method) {
    const std::string name = nameOfMethod(method);
    addRow(table, name + ", here (ms)", method,
           [&](std::size_t m, std::size_t c) { return fixedText(cubes[m][c], 3); });
    addRow(table, name + ", paper (s)", method,
           [](std::size_t m, std::size_t c) { return fixedText(kPublishedSeconds[m][c], 2); });
    if (method == 0) continue;
    addRow(table, name + ", change here", method,
           [&](std::size_t m, std::size_t c) { return changeText(cubes[0][c], cubes[m][c]); });
    addRow(table, name + ", change in the paper", method, [](std::size_t m, std::size_t c) {
      return changeText(kPublishedSeconds[0][c], kPublishedSeconds[m][c]);
    });
  }
  Table clustering{
      .name = "table2_clustering",
      .caption = "Time of k-means, which comes before the splits and is in none of the times above (ms)",
      .columns = {"k"},
      .rows = {{"ms"}}};
  for (std::size_t method = 1; method < kMethods; ++method) {
    clustering.columns.push_back(std::to_string(clustersOfMethod(method)));
    clustering.rows.front().push_back(fixedText(run.result.cluster_ms[method], 3));
  }
  const std::size_t k2 = methodOfClusters(2);
  const double with_clustering = cubes[k2][1] + run.result.cluster_ms[k2];
  return {
      .title = "Table 2: split time",
      .paragraphs =
          {"The processor time to build the octrees of given clusters: the median of interleaved repeats in "
           "one run on this "
           "machine. The paper's times are " +
               fixedText(1e3 * kPublishedSeconds[0][0] / cubes[0][0], 0) +
               " times as long at FNOP 1; only changes against the traditional method of the same "
               "table can be "
               "compared.",
           "Clustering is faster in " + ofCells(cellsBelowTraditional(cubes)) +
               " with cubes along the axes and in " + ofCells(cellsBelowTraditional(principal)) +
               " with boxes in principal frames; in the paper's table in " +
               ofCells(cellsBelowTraditional(kPublishedSeconds)) + ". The mean change is " +
               changeText(1.0, meanRatio(cubes, cubes)) + ", " +
               changeText(1.0, meanRatio(principal, principal)) + " and, in the paper, " +
               changeText(1.0, meanRatio(kPublishedSeconds, kPublishedSeconds)) +
               ". At k = 2 and FNOP 2 it is " + changeText(cubes[0][1], cubes[k2][1]) + " here and " +
               changeText(kPublishedSeconds[0][1], kPublishedSeconds[k2][1]) +
               " in the paper (erratum 11); with the time of k-means it is " +
               changeText(cubes[0][1], with_clustering) + " here."},
      .tables = {
          std::move(table),
          oneRowAMethod("table2_times_principal",
                        "Split time with boxes in principal frames, the finding of the frames included (ms)",
                        [&](std::size_t m, std::size_t c) { return fixedText(principal[m][c], 3); }),
          std::move(clustering)}};
}

Table splitCells(const SplitRun& run) {
  Table table{.name = "split_cells",
              .caption = "All cells of Tables 1 and 2",
              .columns = {"frame", "k", "fnop", "tnon", "paper_tnon", "paper_tnon_possible", "split_ms",
                          "paper_split_s", "leaf_volume_mm3", "false_positives", "clear_poses",
                          "false_negatives", "touching_poses"},
              .rows = {}};
  for (const bool principal : {false, true}) {
    const MethodTable<SplitCell>& cells = principal ? run.result.principal : run.result.cubes;
    for (std::size_t m = 0; m < kMethods; ++m) {
      for (std::size_t c = 0; c < kFnops; ++c) {
        const SplitCell& cell = cells[m][c];
        const int published = kPublishedNodes[m][c];
        table.rows.push_back(
            {principal ? "principal box" : "cube", std::to_string(clustersOfMethod(m)),
             std::to_string(fnopOf(c)), std::to_string(cell.nodes), std::to_string(published),
             canBeNodeCount(published, clustersOfMethod(m)) ? "1" : "0", fixedText(cell.split_ms, 4),
             fixedText(kPublishedSeconds[m][c], 2), fixedText(cell.leaf_volume, 1),
             std::to_string(cell.false_positives), std::to_string(run.result.clear),
             std::to_string(cell.false_negatives), std::to_string(run.result.touching)});
      }
    }
  }
  return table;
}

namespace {

template <typename Number>
Plot plotOf(const MethodTable<Number>& table, std::string title, std::string y_label) {
  Plot plot{.title = std::move(title),
            .x_label = "FNOP (points)",
            .y_label = std::move(y_label),

            .series = {}};
  for (std::size_t m = 0; m < kMethods; ++m) {
    Series series{.name = nameOfMethod(m), .x = {}, .y = {}};
    for (std::size_t c = 0; c < kFnops; ++c) {
      series.x.push_back(static_cast<double>(fnopOf(c)));
      series.y.push_back(static_cast<double>(table[m][c]));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// Against the traditional method, where the differences are seen.
template <typename Number>
Plot changePlotOf(const MethodTable<Number>& table, std::string title, std::string y_label) {
  Plot plot = plotOf(table, std::move(title), std::move(y_label));
  for (std::size_t m = kMethods; m-- > 0;) {
    for (std::size_t c = 0; c < kFnops; ++c) {
      plot.series[m].y[c] = 100.0 * (plot.series[m].y[c] / plot.series[0].y[c] - 1.0);
    }
  }
  plot.series[0].style = SeriesStyle::kLine;
  return plot;
}

}  // namespace

Section splitPlotsSection(const SplitRun& run, const std::filesystem::path& folder) {
  Section section{.title = "Figures 9 and 10"};
  const auto add = [&](const std::string& file, const Plot& plot, const std::string& caption) {
    writeSvg(plot, folder / file);
    section.figures.push_back({file, caption});
  };
  const auto nodes = columnOf(run.result.cubes, &SplitCell::nodes);
  const auto times = columnOf(run.result.cubes, &SplitCell::split_ms);
  const std::string change = "change against the traditional method (%)";
  add("fig9.svg", plotOf(nodes, "Total number of nodes, here", "TNON (nodes)"),
      "Figure 9: nodes over FNOP for each k, cubes along the axes");
  add("fig9_change.svg", changePlotOf(nodes, "Nodes against the traditional method, here", change),
      "Figure 9 again: below 0, clustering makes fewer nodes");
  add("fig9_change_paper.svg",
      changePlotOf(kPublishedNodes, "Nodes against the traditional method, in the paper", change),
      "The same of the paper's Table 1");
  add("fig10.svg", plotOf(times, "Split time, here", "split time (ms)"),
      "Figure 10: split times over FNOP for each k, cubes along the axes");
  add("fig10_change.svg", changePlotOf(times, "Split time against the traditional method, here", change),
      "Figure 10 again: below 0, clustering is faster");
  add("fig10_change_paper.svg",
      changePlotOf(kPublishedSeconds, "Split time against the traditional method, in the paper", change),
      "The same of the paper's Table 2: the cells at FNOP 2 stand apart, as their traditional time does "
      "(erratum 11)");
  return section;
}

}  // namespace octoblisk::demos
