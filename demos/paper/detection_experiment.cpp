#include "paper/detection_experiment.h"

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "build/paper/principal_box.h"
#include "geometry/bounding_box.h"
#include "octoblisk/collide.h"
#include "octoblisk/path_query.h"
#include "paper/box_detection.h"
#include "paper/segmentation.h"
#include "paper/stopwatch.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

/// A detection method, applied to a pose of the belt.
struct Detector {
  std::string method;
  double range = 0.0;  // mm³
  std::function<BoxesLeft(const Pose& belt_in_blisk)> detect;
  bool is_exact = false;
};

/// The poses that it calls colliding, and the volumes that it leaves.
DetectionRow judgedRow(const Detector& detector, const std::vector<BeltPose>& ground,
                       const std::vector<BeltPose>& lifted) {
  DetectionRow row{.method = detector.method, .range = detector.range, .is_exact = detector.is_exact};
  for (const BeltPose& pose : ground) {
    const BoxesLeft left = detector.detect(pose.belt_in_mesh);
    row.ground.count(pose, left.isColliding());
    row.at_ground.push_back({left.isColliding(), left.volume});
    row.volume_left += left.volume / static_cast<double>(ground.size());
    row.boxes_tested += static_cast<double>(left.tested) / static_cast<double>(ground.size());
  }
  for (const BeltPose& pose : lifted) {
    const BoxesLeft left = detector.detect(pose.belt_in_mesh);
    row.lifted.count(pose, left.isColliding());
    row.at_lifted.push_back({left.isColliding(), left.volume});
  }
  return row;
}

double secondsOf(const Detector& detector, const std::vector<BeltPose>& path) {
  const Stopwatch watch;
  for (const BeltPose& pose : path) detector.detect(pose.belt_in_mesh);
  return watch.seconds();
}

/// All methods, in the order of DetectionMethod. The bodies and octrees must outlive them.
std::vector<Detector> detectorsOf(const ClusteredOctree& blisk, const ClusteredOctree& belt,
                                  const PaperOctrees& paper, const Segmentation& improved_principal) {
  const Obb belt_box = principalBox(belt.mesh().vertices());
  const double our_range = blisk.boxes(0).front().volume();
  const auto oneBox = [&](std::string method, const Obb& box) {
    return Detector{std::move(method), box.volume(), [belt_box, box](const Pose& pose) {
                      const bool overlap = overlaps(pose * belt_box, box);
                      return BoxesLeft{1, overlap ? 1u : 0u, overlap ? box.volume() : 0.0};
                    }};
  };
  const auto octrees = [&](std::string method, const Segmentation& segmentation, SeparatingAxes axes) {
    return Detector{std::move(method), segmentation.rootVolume(),
                    [&segmentation, belt_box, axes](const Pose& pose) {
                      return leavesNear(segmentation, pose * belt_box, axes);
                    }};
  };
  std::vector<Detector> detectors(kDetectionMethods);
  detectors[kOneAabb] =
      oneBox("one box along the axes", boundingBox(blisk.mesh().vertices(), Mat3::Identity()));
  detectors[kOneObb] = oneBox("one box along the principal axes", principalBox(blisk.mesh().vertices()));
  detectors[kTraditionalOneAxis] =
      octrees("traditional octree, 1 axis", paper.traditional, SeparatingAxes::first_x);
  detectors[kTraditional] =
      octrees("traditional octree, 15 axes", paper.traditional, SeparatingAxes::exact15);
  detectors[kImprovedOneAxis] = octrees("paper's improved, 1 axis", paper.improved, SeparatingAxes::first_x);
  detectors[kImproved] = octrees("paper's improved, 15 axes", paper.improved, SeparatingAxes::exact15);
  detectors[kImprovedPrincipal] =
      octrees("improved in principal frames, 15 axes", improved_principal, SeparatingAxes::exact15);
  detectors[kOursBoxes] = {
      "ours, boxes against the belt's box", our_range,
      [&blisk, belt_box](const Pose& pose) { return leavesNear(blisk, pose * belt_box); }};
  detectors[kOursBothBoxes] = {"ours, boxes against the belt's boxes", our_range,
                               [&](const Pose& pose) { return leavesNear(blisk, belt, pose); }};
  detectors[kOursPairs] = {"ours, exact: all touching triangle pairs", our_range,
                           [&, pairs = std::vector<TrianglePair>()](const Pose& pose) mutable {
                             touchingPairs(blisk, belt, pose, pairs);
                             return BoxesLeft{0, pairs.size(), 0.0};
                           },
                           true};
  detectors[kOursVerdict] = {"ours, exact: touching or not", our_range,
                             [query = PathQuery(blisk, belt)](const Pose& pose) mutable {
                               return BoxesLeft{0, query.collide(pose) ? 1u : 0u, 0.0};
                             },
                             true};
  return detectors;
}

/// Times all methods in turn, run by run, so that a disturbance of the machine affects all of them.
void timeRuns(const std::vector<Detector>& detectors, const std::vector<BeltPose>& path, int runs,
              std::vector<DetectionRow>& rows, const Progress& progress) {
  for (int run = 0; run < runs; ++run) {
    for (std::size_t method = 0; method < detectors.size(); ++method) {
      rows[method].run_seconds.push_back(secondsOf(detectors[method], path));
    }
    progress(static_cast<double>(run + 1) / runs);
  }
}

/// Leaf boxes, and a test whether the belt's triangles meet any of them.
struct Cover {
  std::string boxes;
  std::function<bool(const Pose& belt_in_blisk)> meets;
};

/// In the order of HoleKind.
std::vector<Cover> coversOf(const ClusteredOctree& blisk, const ClusteredOctree& belt,
                            const PaperOctrees& paper) {
  const auto cells = [&](const Segmentation& segmentation) {
    return [&](const Pose& pose) { return anyLeafMeets(segmentation, belt, pose); };
  };
  const auto fitted = [&](std::span<const Points> clusters, const Segmentation& segmentation) {
    return [&, clusters](const Pose& pose) { return anyFittedBoxMeets(clusters, segmentation, belt, pose); };
  };
  std::vector<Cover> covers(kHoleKinds);
  covers[kCellsTraditional] = {"cells of the traditional octree", cells(paper.traditional)};
  covers[kCellsImproved] = {"cells of the paper's improved octree", cells(paper.improved)};
  covers[kFittedTraditional] = {"boxes around the points of the traditional cells",
                                fitted(std::span(&paper.whole, 1), paper.traditional)};
  covers[kFittedImproved] = {"boxes around the points of the improved cells",
                             fitted(paper.clusters, paper.improved)};
  covers[kWholeTriangles] = {"boxes of whole triangles, ours",
                             [&](const Pose& pose) { return anyLeafMeets(blisk, belt, pose); }};
  return covers;
}

std::vector<HolesRow> holesOf(const std::vector<Cover>& covers, const std::vector<BeltPose>& ground,
                              const std::vector<BeltPose>& lifted, const Progress& progress) {
  std::vector<HolesRow> holes;
  for (const Cover& cover : covers) holes.push_back({.method = cover.boxes});
  std::size_t done = 0;
  for (const std::vector<BeltPose>* path : {&ground, &lifted}) {
    for (const BeltPose& pose : *path) {
      progress(static_cast<double>(++done) / static_cast<double>(ground.size() + lifted.size()));
      if (!pose.touches) continue;
      for (std::size_t kind = 0; kind < covers.size(); ++kind) {
        ++holes[kind].touching;
        holes[kind].missed += !covers[kind].meets(pose.belt_in_mesh);
      }
    }
  }
  return holes;
}

}  // namespace

void Alarms::count(const BeltPose& pose, bool called_colliding) {
  ++(pose.touches ? touching : clear);
  false_positives += called_colliding && !pose.touches;
  false_negatives += !called_colliding && pose.touches;
}

DetectionResult runDetectionExperiment(const ClusteredOctree& blisk, const ClusteredOctree& belt,
                                       const std::vector<Points>& parts, const std::vector<BeltPose>& ground,
                                       const std::vector<BeltPose>& lifted, const DetectionOptions& options,
                                       const Progress& progress) {
  const PaperOctrees paper(parts, options.k_means, options.fnop);
  const Segmentation improved_principal(paper.clusters, options.fnop, CellFrame::principal_box);
  const std::vector<Detector> detectors = detectorsOf(blisk, belt, paper, improved_principal);
  DetectionResult result{.path_poses = ground.size(), .cloud_points = paper.whole.size(), .options = options};
  for (const Detector& detector : detectors) {
    result.rows.push_back(judgedRow(detector, ground, lifted));
    progress(0.3 * static_cast<double>(result.rows.size()) / static_cast<double>(detectors.size()));
  }
  timeRuns(detectors, ground, options.runs, result.rows, stretchOf(progress, 0.3, 0.7));
  result.holes = holesOf(coversOf(blisk, belt, paper), ground, lifted, stretchOf(progress, 0.7, 1.0));
  return result;
}

void to_json(nlohmann::json& json, const DetectionResult& result) {
  const auto of = [](const Alarms& alarms) {
    return nlohmann::json{{"touching", alarms.touching},
                          {"clear", alarms.clear},
                          {"false_positives", alarms.false_positives},
                          {"false_negatives", alarms.false_negatives}};
  };
  json = {{"path_poses", result.path_poses},
          {"cloud_points", result.cloud_points},
          {"fnop", result.options.fnop},
          {"k", result.options.k_means.k}};
  for (const DetectionRow& row : result.rows) {
    json["rows"].push_back({{"method", row.method},
                            {"range", row.range},
                            {"volume_left", row.volume_left},
                            {"boxes_tested", row.boxes_tested},
                            {"run_seconds", row.run_seconds},
                            {"ground", of(row.ground)},
                            {"lifted", of(row.lifted)},
                            {"is_exact", row.is_exact}});
  }
  for (const HolesRow& row : result.holes) {
    json["holes"].push_back({{"method", row.method}, {"touching", row.touching}, {"missed", row.missed}});
  }
}

}  // namespace octoblisk::demos
