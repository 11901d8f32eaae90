#include "paper/detection_section.h"

#include <algorithm>
#include <numeric>

#include "paper/number_text.h"
#include "paper/published.h"

namespace octoblisk::demos {
namespace {

template <typename Seconds>
double mean(const Seconds& seconds) {
  return std::accumulate(seconds.begin(), seconds.end(), 0.0) / static_cast<double>(seconds.size());
}

std::string rangeText(double volume) { return fixedText(1e-4 * volume, 2); }

/// "3 of 40 (7.5 %)"
std::string ofPoses(std::size_t count, std::size_t poses) {
  const std::string text = std::to_string(count) + " of " + std::to_string(poses);
  return poses == 0 ? text
                    : text + " (" + shareText(static_cast<double>(count), static_cast<double>(poses)) + ")";
}

Table methodsTable(const DetectionResult& result) {
  Table table{.name = "table3_methods",
              .caption = "Table 3 here: ranges in 10⁴ mm³, times over the " +
                         std::to_string(result.path_poses) + " poses of the path",
              .columns = {"method", "range at first", "left at a pose", "boxes tested a pose", "time (ms)",
                          "false positives, ground", "false negatives, ground", "false positives, lifted",
                          "false negatives, lifted"},
              .rows = {}};
  for (const DetectionRow& row : result.rows) {
    table.rows.push_back({row.method, rangeText(row.range), row.is_exact ? "–" : rangeText(row.volume_left),
                          row.is_exact ? "–" : fixedText(row.boxes_tested, 0),
                          fixedText(1e3 * mean(row.run_seconds), 2),
                          ofPoses(row.ground.false_positives, row.ground.clear),
                          ofPoses(row.ground.false_negatives, row.ground.touching),
                          ofPoses(row.lifted.false_positives, row.lifted.clear),
                          ofPoses(row.lifted.false_negatives, row.lifted.touching)});
  }
  return table;
}

/// In the paper's form, with the paper's numbers beside it.
Table paperTable(const DetectionResult& result) {
  const DetectionRow &traditional = result.rows[kTraditional], &improved = result.rows[kImproved];
  Table table{
      .name = "table3_paper",
      .caption = "Table 3 in the paper's form: traditional and improved octrees, here and in the paper",
      .columns = {"attribute", "run", "traditional, here", "improved, here", "change, here",
                  "traditional, paper", "improved, paper", "change, paper"},
      .rows = {}};
  const auto add = [&](const std::string& attribute, const std::string& run, double here,
                       double here_improved, double paper, double paper_improved, int digits) {
    table.rows.push_back({attribute, run, fixedText(here, digits), fixedText(here_improved, digits),
                          changeText(here, here_improved, 2), fixedText(paper, 2),
                          fixedText(paper_improved, 2), changeText(paper, paper_improved, 2)});
  };
  add("range (10⁴ mm³)", "all", 1e-4 * traditional.range, 1e-4 * improved.range, kPublishedTraditionalRange,
      kPublishedImprovedRange, 2);
  const std::size_t runs = std::min(traditional.run_seconds.size(), kPublishedTraditionalSeconds.size());
  for (std::size_t k = 0; k < runs; ++k) {
    add("time (s)", std::to_string(k + 1), traditional.run_seconds[k], improved.run_seconds[k],
        kPublishedTraditionalSeconds[k], kPublishedImprovedSeconds[k], 4);
  }
  add("time (s)", "average", mean(traditional.run_seconds), mean(improved.run_seconds),
      mean(kPublishedTraditionalSeconds), mean(kPublishedImprovedSeconds), 4);
  return table;
}

Table holesTable(const DetectionResult& result) {
  Table table{
      .name = "table3_holes",
      .caption =
          "Contacts that leaf boxes do not cover (erratum 14): poses at which the belt's triangles touch "
          "the blisk's, but meet no leaf box",
      .columns = {"boxes", "missed"},
      .rows = {}};
  for (const HolesRow& row : result.holes)
    table.rows.push_back({row.method, ofPoses(row.missed, row.touching)});
  return table;
}

std::string setUp(const DetectionResult& result, const std::string& blisk_name, double lift) {
  const Alarms &ground = result.rows.front().ground, &lifted = result.rows.front().lifted;
  return "The belt's one box along its principal axes against the leaf cells of octrees over " +
         std::to_string(result.cloud_points) + " points of " + blisk_name + ", at FNOP " +
         std::to_string(result.options.fnop) +
         ", improved: blades and hub first, k = " + std::to_string(result.options.clusters) +
         " for each. At every pose all leaf boxes that overlap are found. The range at first is the "
         "volume of the boxes that a method begins with, as in the paper; what is left at a pose is the "
         "volume of "
         "the leaf boxes that overlap, the mean over the path. The path as it is ground has " +
         std::to_string(result.path_poses) + " poses, and the triangles touch at " +
         std::to_string(ground.touching) + " of them, as they must; held " + fixedText(lift, 0) +
         " mm off the blade, they touch at " + std::to_string(lifted.touching) +
         ", each of them interference. Times are processor times of one thread of this machine.";
}

std::string rangeVerdict(const DetectionResult& result) {
  const DetectionRow &traditional = result.rows[kTraditional], &improved = result.rows[kImproved],
                     &ours = result.rows[kOursBothBoxes];
  return "Range: parts and clusters change it by " + changeText(traditional.range, improved.range) +
         " here, by " + changeText(kPublishedTraditionalRange, kPublishedImprovedRange) +
         " in the paper, where it is " + fixedText(kPublishedImprovedRange / kPublishedTraditionalRange, 2) +
         " of the traditional one exactly in every row (erratum 12). What is left at a pose changes by " +
         changeText(traditional.volume_left, improved.volume_left) +
         " with 15 axes; with leaf boxes of whole triangles, against the "
         "belt's own leaf boxes, by " +
         changeText(traditional.volume_left, ours.volume_left) + ".";
}

std::string timeVerdict(const DetectionResult& result) {
  const double traditional = mean(result.rows[kTraditional].run_seconds),
               improved = mean(result.rows[kImproved].run_seconds),
               exact = mean(result.rows[kOursVerdict].run_seconds);
  return "Time: the improved method's changes by " + changeText(traditional, improved) + " here, by " +
         changeText(mean(kPublishedTraditionalSeconds), mean(kPublishedImprovedSeconds)) +
         " in the paper, whose " + fixedText(mean(kPublishedTraditionalSeconds), 0) +
         " s come with no number of poses and no hardware (erratum 13). The exact verdict on the triangles "
         "takes " +
         fixedText(1e6 * exact / static_cast<double>(result.path_poses), 1) +
         " µs a pose, the traditional boxes " +
         fixedText(1e6 * traditional / static_cast<double>(result.path_poses), 1) + " µs.";
}

std::string accuracyVerdict(const DetectionResult& result) {
  const auto lifted = [&](DetectionMethod method) {
    const Alarms& alarms = result.rows[method].lifted;
    return ofPoses(alarms.false_positives, alarms.clear);
  };
  std::size_t exact_errors = 0;
  for (const DetectionMethod method : {kOursPairs, kOursVerdict}) {
    for (const Alarms* alarms : {&result.rows[method].ground, &result.rows[method].lifted}) {
      exact_errors += alarms->false_positives + alarms->false_negatives;
    }
  }
  std::size_t point_boxes_missed = 0;
  for (const DetectionMethod method : {kTraditionalOneAxis, kTraditional, kImprovedOneAxis, kImproved}) {
    point_boxes_missed +=
        result.rows[method].ground.false_negatives + result.rows[method].lifted.false_negatives;
  }
  return "Accuracy: of the poses held off the blade that are clear, one box round the whole blisk raises a "
         "false "
         "alarm at " +
         lifted(kOneAabb) + "; the traditional octree with the paper's one axis at " +
         lifted(kTraditionalOneAxis) + ", with fifteen at " + lifted(kTraditional) +
         "; parts and clusters at " + lifted(kImproved) + "; our leaf boxes at " + lifted(kOursBoxes) +
         ". What is left of them is the belt's one box: against the belt's own leaf boxes ours raise " +
         lifted(kOursBothBoxes) + ". With the belt's box, the paper's methods miss " +
         countedText(point_boxes_missed, "touch", "touches") +
         ". The exact rows differ from the triangles' verdict at " +
         countedText(exact_errors, "pose", "poses") + ".";
}

std::string holesVerdict(const DetectionResult& result) {
  std::string text =
      "Holes (erratum 14): the belt's box is larger than the belt, which hides what the blisk's boxes do not "
      "cover. "
      "Asked with the belt's triangles, of the poses of both paths at which they touch the blisk's, they "
      "meet none ";
  for (std::size_t i = 0; i < result.holes.size(); ++i) {
    const HolesRow& row = result.holes[i];
    text += (i == 0 ? "of the " : "; of the ") + row.method + " at " + ofPoses(row.missed, row.touching);
  }
  return text + ".";
}

}  // namespace

Section detectionSection(const DetectionResult& result, const std::string& blisk_name, double lift) {
  return {.title = "Table 3: detection over the grinding path",
          .paragraphs = {setUp(result, blisk_name, lift), rangeVerdict(result), timeVerdict(result),
                         accuracyVerdict(result), holesVerdict(result)},
          .tables = {paperTable(result), methodsTable(result), holesTable(result)}};
}

}  // namespace octoblisk::demos
