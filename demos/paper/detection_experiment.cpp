#include "paper/detection_experiment.h"

#include <algorithm>
#include <functional>

#include "octoblisk/collide.h"
#include "octoblisk/obb.h"
#include "octoblisk/path_query.h"
#include "paper/box_detection.h"
#include "paper/stopwatch.h"

namespace octoblisk::demos {
namespace {

/// One way to detect: what is left at a pose of the belt.
struct Detector {
  std::string method;
  double range = 0.0;  // mm³
  std::function<BoxesLeft(const Pose& belt_in_blisk)> detect;
  bool is_exact = false;
};

/// What it calls colliding, and what it leaves.
DetectionRow judgedRow(const Detector& detector, const std::vector<BeltPose>& ground,
                       const std::vector<BeltPose>& lifted) {
  DetectionRow row{.method = detector.method, .range = detector.range, .is_exact = detector.is_exact};
  for (const BeltPose& pose : ground) {
    const BoxesLeft left = detector.detect(pose.belt_in_mesh);
    row.ground.count(pose, left.isColliding());
    row.volume_left += left.volume / static_cast<double>(ground.size());
    row.boxes_tested += static_cast<double>(left.tested) / static_cast<double>(ground.size());
  }
  for (const BeltPose& pose : lifted)
    row.lifted.count(pose, detector.detect(pose.belt_in_mesh).isColliding());
  return row;
}

double secondsOf(const Detector& detector, const std::vector<BeltPose>& path) {
  const Stopwatch watch;
  for (const BeltPose& pose : path) detector.detect(pose.belt_in_mesh);
  return watch.seconds();
}

Points joined(const std::vector<Points>& parts) {
  Points whole;
  for (const Points& part : parts) whole.insert(whole.end(), part.begin(), part.end());
  return whole;
}

std::vector<Points> clustersOfParts(const std::vector<Points>& parts, const DetectionOptions& options) {
  std::vector<Points> clusters;
  for (const Points& part : parts) {
    for (Points& cluster : clustersOf(part, std::min(options.clusters, part.size()), options.seed)) {
      clusters.push_back(std::move(cluster));
    }
  }
  return clusters;
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
  const Points whole = joined(parts);
  const std::vector<Points> clusters = clustersOfParts(parts, options);
  const Segmentation traditional(std::span(&whole, 1), options.fnop, CellFrame::box);
  const Segmentation improved(clusters, options.fnop, CellFrame::box);
  const Segmentation improved_principal(clusters, options.fnop, CellFrame::principal_box);
  const Obb belt_box = principalBox(belt.mesh().vertices());
  const Obb one_aabb = boundingBox(blisk.mesh().vertices(), Mat3::Identity());
  const Obb one_obb = principalBox(blisk.mesh().vertices());
  const double our_range = blisk.box(ClusteredOctree::kRoot).volume();

  const auto oneBox = [&](const Obb& box) {
    return [&belt_box, box](const Pose& pose) {
      const bool overlap = overlaps(pose * belt_box, box);
      return BoxesLeft{1, overlap ? 1u : 0u, overlap ? box.volume() : 0.0};
    };
  };
  const auto octrees = [&](const Segmentation& segmentation, SeparatingAxes axes) {
    return [&, axes](const Pose& pose) { return leavesNear(segmentation, pose * belt_box, axes); };
  };
  std::vector<TrianglePair> pairs;
  PathQuery path_query(blisk, belt);
  std::vector<Detector> detectors(kDetectionMethods);
  detectors[kOneAabb] = {"one box along the axes", one_aabb.volume(), oneBox(one_aabb)};
  detectors[kOneObb] = {"one box along the principal axes", one_obb.volume(), oneBox(one_obb)};
  detectors[kTraditionalOneAxis] = {"traditional octree, 1 axis", traditional.rootVolume(),
                                    octrees(traditional, SeparatingAxes::paper1)};
  detectors[kTraditional] = {"traditional octree, 15 axes", traditional.rootVolume(),
                             octrees(traditional, SeparatingAxes::exact15)};
  detectors[kImprovedOneAxis] = {"paper's improved, 1 axis", improved.rootVolume(),
                                 octrees(improved, SeparatingAxes::paper1)};
  detectors[kImproved] = {"paper's improved, 15 axes", improved.rootVolume(),
                          octrees(improved, SeparatingAxes::exact15)};
  detectors[kImprovedPrincipal] = {"improved in principal frames, 15 axes", improved_principal.rootVolume(),
                                   octrees(improved_principal, SeparatingAxes::exact15)};
  detectors[kOursBoxes] = {"ours, boxes against the belt's box", our_range,
                           [&](const Pose& pose) { return leavesNear(blisk, pose * belt_box); }};
  detectors[kOursBothBoxes] = {"ours, boxes against the belt's boxes", our_range,
                               [&](const Pose& pose) { return leavesNear(blisk, belt, pose); }};
  detectors[kOursPairs] = {"ours, exact: all pairs of triangles that touch", our_range,
                           [&](const Pose& pose) {
                             touchingPairs(blisk, belt, pose, pairs);
                             return BoxesLeft{0, pairs.size(), 0.0};
                           },
                           true};
  detectors[kOursVerdict] = {"ours, exact: touching or not", our_range,
                             [&](const Pose& pose) {
                               return BoxesLeft{0, path_query.collide(pose) ? 1u : 0u, 0.0};
                             },
                             true};

  DetectionResult result{.path_poses = ground.size(), .cloud_points = whole.size(), .options = options};
  for (const Detector& detector : detectors) {
    result.rows.push_back(judgedRow(detector, ground, lifted));
    progress(0.3 * static_cast<double>(result.rows.size()) / static_cast<double>(detectors.size()));
  }
  for (int k = 0; k < options.runs; ++k) {  // all methods in turn: what disturbs the machine disturbs all
    for (std::size_t method = 0; method < kDetectionMethods; ++method) {
      result.rows[method].run_seconds.push_back(secondsOf(detectors[method], ground));
    }
    progress(0.3 + 0.4 * (k + 1) / options.runs);
  }

  result.holes.resize(kHoleKinds);
  result.holes[kCellsTraditional].method = "cells of the traditional octree";
  result.holes[kCellsImproved].method = "cells of the paper's improved one";
  result.holes[kFittedTraditional].method = "boxes round the points of the traditional cells";
  result.holes[kFittedImproved].method = "boxes round the points of the improved cells";
  result.holes[kWholeTriangles].method = "boxes of whole triangles, ours";
  std::size_t done = 0;
  for (const std::vector<BeltPose>* poses : {&ground, &lifted}) {
    for (const BeltPose& pose : *poses) {
      progress(0.7 + 0.3 * static_cast<double>(++done) / static_cast<double>(ground.size() + lifted.size()));
      if (!pose.touches) continue;
      const Pose& at = pose.belt_in_mesh;
      for (HolesRow& row : result.holes) ++row.touching;
      result.holes[kCellsTraditional].missed += !anyLeafMeets(traditional, belt, at);
      result.holes[kCellsImproved].missed += !anyLeafMeets(improved, belt, at);
      result.holes[kFittedTraditional].missed +=
          !anyFittedBoxMeets(std::span(&whole, 1), traditional, belt, at);
      result.holes[kFittedImproved].missed += !anyFittedBoxMeets(clusters, improved, belt, at);
      result.holes[kWholeTriangles].missed += !anyLeafMeets(blisk, belt, at);
    }
  }
  return result;
}

}  // namespace octoblisk::demos
